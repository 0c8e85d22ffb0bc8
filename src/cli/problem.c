/* From given values to an impact. The sphere's centre moves with `speed` at `angle` from the normal.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "problem.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

struct values values_none(void)
{
    struct values values;
    memset(&values, 0, sizeof values);
    values.rotation_blocked = -1;
    return values;
}

bool values_read(char *const texts[FIELD_COUNT], struct values *values, struct reason *why)
{
    for (enum field field = 0; field < FIELD_COUNT; field++) {
        char place[40];
        if (!texts[field]) continue;
        snprintf(place, sizeof place, "--%s", field_rules[field].option);
        if (!field_read(field, texts[field], place, &values->number[field], why)) return false;
        values->given[field] = true;
    }
    return true;
}

bool values_dimensionless(const struct values *values)
{
    for (enum field field = 0; field <= FIELD_LAST_DIMENSIONLESS; field++)
        if (values->given[field]) return true;
    return false;
}

bool values_physical(const struct values *values)
{
    for (enum field field = FIELD_LAST_DIMENSIONLESS + 1; field < FIELD_COUNT; field++)
        if (values->given[field]) return true;
    return values->material || values->deformable || values->rotation_blocked >= 0;
}

bool partner_read(const char *text, const char *place, struct values *values, struct reason *why)
{
    const char *ending = strrchr(text, '.');
    values->deformable = RESTITUTE_ONE_BODY_DEFORMS;
    values->partner = NULL;
    if (strcmp(text, "same") == 0)
        values->deformable = RESTITUTE_BOTH_BODIES_DEFORM;
    else if (ending && (strcmp(ending, ".json") == 0 || strcmp(ending, ".csv") == 0))
        values->partner = text; /* the two materials as one solid */
    else if (strcmp(text, "rigid") != 0)
        return refuse(why, "%s = \"%.64s\": must be rigid, same or a material file, .json or .csv", place, text);
    return true;
}

const char *partner_word(const struct values *values)
{
    if (values->partner) return values->partner;
    return values->deformable == RESTITUTE_BOTH_BODIES_DEFORM ? "same" : "rigid";
}

bool switch_read(const char *text, const char *place, int *on, struct reason *why)
{
    if (strcmp(text, "0") != 0 && strcmp(text, "1") != 0)
        return refuse(why, "%s = \"%.64s\": must be 0 or 1", place, text);
    *on = *text == '1';
    return true;
}

bool values_take(const char *name, const char *cell, struct values *values, struct reason *why)
{
    const enum field field = field_of_column(name);
    if (field < FIELD_COUNT) {
        if (!*cell && field_rules[field].may_be_empty) return true;
        if (!*cell) return refuse(why, "%s is empty: %s", name, field_rules[field].range);
        values->given[field] = true;
        return field_read(field, cell, name, &values->number[field], why);
    }
    if (!*cell) return refuse(why, "%s is empty", name);
    if (strcmp(name, "partner") == 0) return partner_read(cell, name, values, why);
    if (strcmp(name, "rotation_blocked") == 0) return switch_read(cell, name, &values->rotation_blocked, why);
    values->material = cell;
    return true;
}

/* How a field is called here, with the dashes of an option. */
static struct reason called(enum field field, enum naming naming)
{
    struct reason name;
    if (naming == NAME_OPTIONS)
        refuse(&name, "--%s", field_rules[field].option);
    else
        refuse(&name, "%s", field_rules[field].column);
    return name;
}

static bool missing(enum field field, enum naming naming, struct reason *why)
{
    return refuse(why, "%s is missing: %s", called(field, naming).text, field_rules[field].range);
}

static bool check_dimensionless(const struct values *values, enum naming naming, struct reason *why)
{
    const bool *given = values->given;
    if (!given[FIELD_PSI]) return missing(FIELD_PSI, naming, why);
    if (given[FIELD_DELTA1] && given[FIELD_GAMMA] && given[FIELD_DELTA2])
        return refuse(why, "delta1, gamma and delta2 are given: two of them determine the third");
    if (given[FIELD_DELTA2] && !given[FIELD_DELTA1] && !given[FIELD_GAMMA])
        return refuse(why, "delta2 needs delta1 or gamma beside it");
    return true;
}

/* One of two fields that say the same. */
static bool at_most_one(const struct values *values, enum field one, enum field other, enum naming naming,
                        struct reason *why)
{
    if (!values->given[one] || !values->given[other]) return true;
    return refuse(why, "%s and %s are both given: one determines the other", called(one, naming).text,
                  called(other, naming).text);
}

static bool check_physical(const struct values *values, enum naming naming, struct reason *why)
{
    static const enum field required[] = {FIELD_RADIUS1, FIELD_SPEED, FIELD_FRICTION};
    if (!values->material && !values->given[FIELD_MODULUS1])
        return refuse(why, "%s is missing: a material file, .json or .csv (or %s and what belongs to it)",
                      naming == NAME_OPTIONS ? "--material" : "material", called(FIELD_MODULUS1, naming).text);
    for (enum field field = FIELD_MODULUS1; field <= FIELD_POISSON && values->material; field++)
        if (values->given[field])
            return refuse(why, "a material file and %s are both given: use one", called(field, naming).text);
    for (size_t i = 0; i < sizeof required / sizeof required[0]; i++)
        if (!values->given[required[i]]) return missing(required[i], naming, why);
    return at_most_one(values, FIELD_DENSITY1, FIELD_MASS1, naming, why) &&
           at_most_one(values, FIELD_DENSITY2, FIELD_MASS2, naming, why);
}

bool values_check(const struct values *values, enum naming naming, struct reason *why)
{
    const bool physical = values_physical(values), dimensionless = values_dimensionless(values);
    if (physical && dimensionless)
        return refuse(why,
                      "dimensionless values (chi, psi, delta1, gamma, delta2) and values in SI units or a material "
                      "are both given: use one kind");
    if (!physical && !dimensionless)
        return refuse(why,
                      "no impact is described: give psi, delta1, gamma or a material, radius, speed; see restitute "
                      "pair --help");
    return physical ? check_physical(values, naming, why) : check_dimensionless(values, naming, why);
}

/* (25): delta2 = delta1 sqrt(gamma) gives whichever of the two is missing. */
static bool resolve_delta2(const struct values *values, restitute_impact *impact, enum naming naming,
                           struct reason *why)
{
    const double delta2 = values->number[FIELD_DELTA2];
    const enum field other = values->given[FIELD_GAMMA] ? FIELD_GAMMA : FIELD_DELTA1;
    const double known = values->number[other];
    if (!(known > 0 && isfinite(known)))
        return refuse(why, "%s = %s: must be finite and > 0 beside delta2", called(other, naming).text,
                      number_text(known).text);
    if (other == FIELD_GAMMA)
        impact->delta1 = delta2 / sqrt(known);
    else
        impact->gamma = (delta2 / known) * (delta2 / known);
    return true;
}

static bool build_impact(const struct values *values, enum naming naming, struct problem *problem, struct reason *why)
{
    restitute_impact *impact = &problem->impact;
    const bool *given = values->given;
    restitute_impact_init(impact);
    impact->psi = values->number[FIELD_PSI];
    if (given[FIELD_CHI]) impact->chi = values->number[FIELD_CHI];
    if (given[FIELD_DELTA1]) impact->delta1 = values->number[FIELD_DELTA1];
    if (given[FIELD_GAMMA]) impact->gamma = values->number[FIELD_GAMMA];
    if (given[FIELD_DELTA2]) return resolve_delta2(values, impact, naming, why);
    if (impact->delta1 > 0 && !given[FIELD_GAMMA])
        return refuse(why, "%s is missing: delta1 > 0 needs gamma (0: Kelvin-Voigt) or delta2",
                      called(FIELD_GAMMA, naming).text);
    return true;
}

static double mass_of_sphere(double density, double radius)
{
    return 4.0 / 3.0 * pi * radius * radius * radius * density;
}

/* The mass of body 1 or 2, from its mass or its density, or from the material's where both are of it. */
static bool find_mass(const struct values *values, const struct problem *problem, enum field mass, enum field density,
                      enum naming naming, double radius, double *result, struct reason *why)
{
    const bool both = values->deformable == RESTITUTE_BOTH_BODIES_DEFORM;
    if (values->given[mass])
        *result = values->number[mass];
    else if (values->given[density])
        *result = mass_of_sphere(values->number[density], radius);
    else if (both && !isnan(problem->info->density))
        *result = mass_of_sphere(problem->info->density, radius);
    else
        return refuse(why, "%s or %s is missing: must be > 0%s", called(density, naming).text,
                      called(mass, naming).text, both ? " (the material file gives no density)" : "");
    if (!(*result > 0) || (isinf(*result) && mass == FIELD_MASS1))
        return refuse(why, "radius %s m gives a mass of %s kg: must be finite and > 0", number_text(radius).text,
                      number_text(*result).text);
    return true;
}

static bool build_bodies(const struct values *values, enum naming naming, struct problem *problem, struct reason *why)
{
    restitute_scene *scene = &problem->scene;
    const double *number = values->number;
    scene->radius1 = number[FIELD_RADIUS1];
    if (!find_mass(values, problem, FIELD_MASS1, FIELD_DENSITY1, naming, scene->radius1, &scene->mass1, why))
        return false;
    if (values->given[FIELD_INERTIA1]) scene->inertia1 = number[FIELD_INERTIA1];
    if (values->given[FIELD_RADIUS2] && isfinite(number[FIELD_RADIUS2])) {
        scene->radius2 = number[FIELD_RADIUS2];
        if (!find_mass(values, problem, FIELD_MASS2, FIELD_DENSITY2, naming, scene->radius2, &scene->mass2, why))
            return false;
        if (values->given[FIELD_INERTIA2]) scene->inertia2 = number[FIELD_INERTIA2];
        return true;
    }
    static const enum field of_a_sphere[] = {FIELD_MASS2, FIELD_DENSITY2, FIELD_INERTIA2, FIELD_SPIN2};
    for (size_t i = 0; i < sizeof of_a_sphere / sizeof of_a_sphere[0]; i++)
        if (values->given[of_a_sphere[i]] && !(isinf(number[of_a_sphere[i]]) || number[of_a_sphere[i]] == 0))
            return refuse(why, "%s = %s: needs a partner sphere, %s", called(of_a_sphere[i], naming).text,
                          number_text(number[of_a_sphere[i]]).text, called(FIELD_RADIUS2, naming).text);
    return true;
}

/* Of a file, or of numbers; with its times shifted. */
static const struct material_entry *find_material(const struct values *values, enum naming naming,
                                                  struct materials *materials, struct reason *why)
{
    const double *number = values->number;
    const bool *given = values->given;
    struct solid_numbers solid = {.base = NULL,
                                  .modulus1 = number[FIELD_MODULUS1],
                                  .modulus2 = given[FIELD_MODULUS2] ? number[FIELD_MODULUS2] : INFINITY,
                                  .viscosity = number[FIELD_VISCOSITY],
                                  .poisson = given[FIELD_POISSON] ? number[FIELD_POISSON] : 0.5,
                                  .shift = given[FIELD_TIME_SHIFT] ? number[FIELD_TIME_SHIFT] : 1};
    if (values->material && !(solid.base = materials_get(materials, values->material, why))) return NULL;
    if (solid.base && solid.shift == 1) return solid.base;
    if (values->partner) {
        refuse(why, "partner = %.200s: the material must be a file without %s", values->partner,
               called(FIELD_TIME_SHIFT, naming).text);
        return NULL;
    }
    const bool no_dashpot = given[FIELD_MODULUS2] && !given[FIELD_VISCOSITY];
    const bool no_spring = solid.modulus1 == 0 && !given[FIELD_MODULUS2];
    if (!solid.base && (no_dashpot || no_spring)) {
        missing(no_dashpot ? FIELD_VISCOSITY : FIELD_MODULUS2, naming, why);
        return NULL;
    }
    return materials_make(materials, &solid, why);
}

static bool build_scene(const struct values *values, enum naming naming, struct materials *materials,
                        struct problem *problem, struct reason *why)
{
    restitute_scene *scene = &problem->scene;
    const double *number = values->number, angle = number[FIELD_ANGLE] * pi / 180.0;
    const struct material_entry *entry = find_material(values, naming, materials, why);
    if (!entry) return false;
    restitute_scene_init(scene);
    problem->info = &entry->info;
    scene->material = values->partner ? materials_pair(materials, entry, values->partner, why) : entry->material;
    if (!scene->material) return false;
    if (!isnan(entry->info.density)) scene->wave_density = entry->info.density;
    if (values->deformable) scene->deformable = values->deformable;
    scene->rotation_blocked = values->rotation_blocked > 0;
    scene->friction = number[FIELD_FRICTION];
    scene->normal_speed = number[FIELD_SPEED] * cos(angle);
    scene->tangential_speed = number[FIELD_SPEED] * sin(angle);
    scene->spin1 = number[FIELD_SPIN1];
    scene->spin2 = number[FIELD_SPIN2];
    return build_bodies(values, naming, problem, why);
}

bool problem_build(const struct values *values, enum naming naming, struct materials *materials,
                   struct problem *problem, struct reason *why)
{
    memset(problem, 0, sizeof *problem);
    if (!values_check(values, naming, why)) return false;
    problem->physical = values_physical(values);
    return problem->physical ? build_scene(values, naming, materials, problem, why)
                             : build_impact(values, naming, problem, why);
}

int problem_solve(restitute_solver *solver, const struct problem *problem, restitute_result *result,
                  restitute_ledger *ledger, restitute_history *history, restitute_error *error)
{
    if (problem->physical) return restitute_solve_scene(solver, &problem->scene, result, ledger, history, error);
    return restitute_solve(solver, &problem->impact, result, ledger, history, error);
}
