/* The table of fields, and reading one.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "fields.h"

#include <math.h>
#include <string.h>

#include "files/number.h"

#define POSITIVE 0.0, INFINITY, false, false
#define POSITIVE_OR_INFINITE 0.0, INFINITY, false, true
#define FINITE -INFINITY, INFINITY, false, false

const struct field_rule field_rules[FIELD_COUNT] = {
    [FIELD_CHI] = {"chi", NULL, "chi", "1", 1.0 / 3.0, 1000, true, true, false, "must be in [1/3, 1000]",
                   "(1-nu)/(2-nu) (1 + m R^2/J), in [1/3, 1000]; default 7/6, a solid incompressible sphere"},
    [FIELD_PSI] = {"psi", NULL, "psi", "1", 0.0, 1e12, true, true, false, "must be in [0, 1e12]",
                   "(2-2nu)/(2-nu) |tangential velocity of the contact point| / (friction * normal velocity), in "
                   "[0, 1e12]; 0: no slip; required"},
    [FIELD_DELTA1] = {"delta1", NULL, "delta1", "1", 0.0, 1e12, true, true, false, "must be in [0, 1e12]",
                      "eta sqrt(a_el/(G1 m (1-nu))), in [0, 1e12]; default 0: elastic"},
    [FIELD_GAMMA] = {"gamma", NULL, "gamma", "1", 0.0, INFINITY, true, true, false, "must be >= 0 (inf: elastic)",
                     "G1/G2, >= 0; 0: Kelvin-Voigt, inf: elastic; required if delta1 > 0"},
    [FIELD_DELTA2] = {"delta2", NULL, "delta2", "1", 0.0, 1e12, false, true, false, "must be in (0, 1e12]",
                      "delta1 sqrt(gamma), in (0, 1e12]; instead of gamma or of delta1"},
    [FIELD_RADIUS1] = {"radius", "radius1", "radius1_m", "m", POSITIVE, false, "must be finite and > 0",
                       "radius of the sphere, m; required"},
    [FIELD_DENSITY1] = {"density", "density1", "density1_kg_m3", "kg/m^3", POSITIVE, true, "must be finite and > 0",
                        "density of the sphere, kg/m^3; this or --mass1; default the material's with --partner same"},
    [FIELD_MASS1] = {"mass1", "mass", "mass1_kg", "kg", POSITIVE, true, "must be finite and > 0",
                     "mass of the sphere, kg"},
    [FIELD_INERTIA1] = {"inertia1", "inertia", "inertia1_kg_m2", "kg m^2", POSITIVE, true, "must be finite and > 0",
                        "moment of inertia, kg m^2; default solid, 2/5 m R^2"},
    [FIELD_RADIUS2] = {"radius2", NULL, "radius2_m", "m", POSITIVE_OR_INFINITE, true, "must be > 0 (inf: a wall)",
                       "radius of the partner, m; default inf: a wall"},
    [FIELD_DENSITY2] = {"density2", NULL, "density2_kg_m3", "kg/m^3", POSITIVE_OR_INFINITE, true,
                        "must be > 0 (inf: held fast)", "density of the partner sphere, kg/m^3; this or --mass2"},
    [FIELD_MASS2] = {"mass2", NULL, "mass2_kg", "kg", POSITIVE_OR_INFINITE, true, "must be > 0 (inf: held fast)",
                     "mass of the partner sphere, kg; inf: held fast"},
    [FIELD_INERTIA2] = {"inertia2", NULL, "inertia2_kg_m2", "kg m^2", POSITIVE, true, "must be finite and > 0",
                        "its moment of inertia, kg m^2; default solid"},
    [FIELD_SPEED] = {"velocity", "speed", "speed_m_s", "m/s", POSITIVE, false, "must be finite and > 0",
                     "speed of the sphere's centre relative to the partner, m/s; required"},
    [FIELD_ANGLE] = {"angle", NULL, "angle_deg", "deg", 0.0, 90.0, true, false, false, "must be in [0, 90)",
                     "angle between the velocity and the normal, degrees, in [0, 90); default 0"},
    [FIELD_SPIN1] = {"spin", "spin1", "spin_rad_s", "rad/s", FINITE, true, "must be finite",
                     "spin of the sphere, rad/s; positive spin adds to the sliding velocity v sin(angle) + R1 spin + "
                     "R2 spin2, backspin is negative; default 0"},
    [FIELD_SPIN2] = {"spin2", NULL, "spin2_rad_s", "rad/s", FINITE, true, "must be finite",
                     "spin of the partner sphere, rad/s, of the same sign; default 0"},
    [FIELD_FRICTION] = {"friction", NULL, "friction", "1", 0.0, INFINITY, true, true, false,
                        "must be >= 0 (inf: no slip)", "coefficient of friction, >= 0; inf: no slip; required"},
    [FIELD_MODULUS1] = {"modulus1", "modulus", "modulus1_Pa", "Pa", 0.0, INFINITY, true, false, true,
                        "must be finite and >= 0",
                        "instead of --material: G1 of a standard solid, Pa; 0: Maxwell; alone: elastic"},
    [FIELD_MODULUS2] = {"modulus2", NULL, "modulus2_Pa", "Pa", POSITIVE, true, "must be finite and > 0",
                        "G2, Pa, in series with the dashpot; without it Kelvin-Voigt"},
    [FIELD_VISCOSITY] = {"viscosity", NULL, "viscosity_Pa_s", "Pa s", POSITIVE, true, "must be finite and > 0",
                         "eta of the dashpot, Pa s"},
    [FIELD_POISSON] = {"poisson", NULL, "poisson_ratio", "1", 0.0, 0.5, true, true, true, "must be in [0, 0.5]",
                       "Poisson's ratio of that solid; default 0.5"},
    [FIELD_TIME_SHIFT] = {"time-shift", NULL, "time_shift", "1", POSITIVE, true, "must be finite and > 0",
                          "a_T: relaxation times and viscosity are multiplied by it, as by a change of temperature; "
                          "default 1"},
};

static bool in_range(const struct field_rule *rule, double value)
{
    const bool above = rule->low_allowed ? value >= rule->low : value > rule->low;
    const bool below = rule->high_allowed ? value <= rule->high : value < rule->high;
    return above && below;
}

bool field_read(enum field field, const char *text, const char *place, double *value, struct reason *why)
{
    const struct field_rule *rule = &field_rules[field];
    double number;
    const int status = rst_number_read(text, &number);
    if (status == RESTITUTE_ERROR_DOMAIN)
        return refuse(why, "%s = %.64s is too large or too small for a double: %s", place, text, rule->range);
    if (status != RESTITUTE_OK) return refuse(why, "%s = \"%.64s\" is not a number: %s", place, text, rule->range);
    if (!in_range(rule, number)) return refuse(why, "%s = %s: %s", place, number_text(number).text, rule->range);
    *value = number;
    return true;
}

enum field field_of_column(const char *column)
{
    enum field field = 0;
    while (field < FIELD_COUNT && strcmp(field_rules[field].column, column) != 0)
        field++;
    return field;
}
