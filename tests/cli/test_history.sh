#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The history: columns with units, evenly spaced rows, and velocities that begin and end as the pair
# says.
. "$(dirname -- "$0")/common.sh"

expect 0 history $scene --velocity 1 --angle 30
[ "$(head -1 out)" = "time_s,indentation_m,contact_radius_m,stick_radius_m,normal_force_N,tangential_force_N,\
normal_velocity_m_s,tangential_velocity_m_s" ] || fail "the header is $(head -1 out)"
# At most 500 rows by default; a sample falls on a whole number of steps, so it may be some fewer.
last=$(($(wc -l <out) - 1))
[ "$last" -le 500 ] && [ "$last" -ge 400 ] || fail "$last rows, not about 500"
cp out history.csv
near "$(value history.csv normal_velocity_m_s 1)" 0.8660254037844387 1e-12 # cos 30 deg: the input, to rounding
near "$(value history.csv tangential_velocity_m_s 1)" 0.5 1e-12
near "$(value history.csv time_s 1)" 0 0
expect 0 pair $scene --velocity 1 --angle 30 --format csv
# The tolerance of each of the two runs is 1e-3.
near "$(awk -v v="$(value history.csv normal_velocity_m_s "$last")" 'BEGIN { print -v / 0.8660254037844387 }')" "$(value out ez)" 2e-3
near "$(awk -v v="$(value history.csv tangential_velocity_m_s "$last")" 'BEGIN { print -v / 0.5 }')" "$(value out ex)" 2e-3
awk -F, 'NR > 2 && $1 <= before { exit 1 } { before = $1 }' history.csv || fail "time does not increase"
awk -F, 'NR > 1 && ($4 > $3 * (1 + 1e-9) || $3 < 0 || $5 < 0) { exit 1 }' history.csv ||
    fail "stick beyond the contact, or a force that pulls"

expect 0 history --psi 2 --delta1 1 --gamma 1 --samples 20 --output h.csv
[ "$(head -1 h.csv)" = "time_T,indentation_d0,contact_radius_a_el,stick_radius_a_el,normal_force_F0,\
tangential_force_mu_F0,normal_velocity_v0,tangential_velocity_V0" ] || fail "the header is $(head -1 h.csv)"
[ "$(wc -l <h.csv)" -le 21 ] && [ "$(wc -l <h.csv)" -ge 15 ] || fail "not about 20 rows"
near "$(value h.csv tangential_velocity_V0 1)" 2 1e-12 # psi
has h.csv.meta.json '"time_T": "T"' '"version"'

if have_module matplotlib; then
    expect 0 history $scene --velocity 1 --angle 30 --output h.csv --figure h.svg
    has h.svg '<svg' '</svg>' Forces Velocities
fi
refused '--velocity = 0' history $scene --velocity 0
refused 'unknown option' history --psi 1 --grid speed=1:2:2
