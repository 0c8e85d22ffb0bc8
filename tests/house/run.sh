#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Runs a Python script: run.sh SCRIPT ARGUMENT...
if ! python3 -c ''; then
    echo "skipped: python3 is missing"
    exit 77
fi
exec python3 -B "$@"
