#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The campaigns in short:  check_campaigns.sh CAMPAIGN.py ...
# From the environment: SOURCE_DIR, PYTHON, and PACKAGE, the folder of the built package. The
# working directory is used up. Exit status 77 without matplotlib.
set -eu
"$PYTHON" -c "import matplotlib" 2>/dev/null || { echo "skipped: no matplotlib for $PYTHON" && exit 77; }

campaign() {
    PYTHONPATH=$PACKAGE "$PYTHON" -B "$SOURCE_DIR/tests/benchmark/$@"
}

for name; do
    case $name in
    bem_campaign.py)
        mkdir -p docs/records docs/figures
        cp "$SOURCE_DIR/docs/records/bem.md" docs/records
        campaign "$name" docs 10 32 128
        grep -q '^| 128 x 128 | all | 10 | 0 |' docs/records/bem.md
        [ "$(grep -c 'differences are below' docs/records/bem.md)" -eq 2 ]
        [ -s docs/figures/bem.svg ]
        ;;
    table_campaign.py)
        campaign "$name" solids 200 1 >solids
        [ "$(grep -c '^| elastic | 0.3 ' solids)" -eq 1 ]
        campaign "$name" random 200 1
        ;;
    fit_coverage.py) # without noise every interval holds the true value
        campaign "$name" 1 | tee coverage
        [ "$(grep -c ',0,[a-z].*,1.000,1.000,0,0$' coverage)" -ge 10 ]
        ;;
    esac
done
