/* Families of impacts: checks, a copy of all that is needed, and single impacts of them.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "family.h"

#include <float.h>
#include <stdlib.h>

void restitute_table_family_init(restitute_table_family *family)
{
    if (!family) return;
    *family = (restitute_table_family){.struct_size = sizeof *family,
                                       .speed = {1e-4, 100},
                                       .chi = {7.0 / 6, 7.0 / 6},
                                       .delta1 = {1e-3, 100},
                                       .gamma = {1, 1}};
}

static int check_range(const double range[2], const char *name, double low, double high, double ratio,
                       restitute_error *error)
{
    if (!(range[0] >= low && range[1] <= high && range[0] <= range[1]))
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "%s = %g to %g: must rise within %g to %g", name, range[0],
                          range[1], low, high);
    if (range[1] / range[0] > ratio)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "%s = %g to %g: highest over lowest must be <= %g", name,
                          range[0], range[1], ratio);
    return RESTITUTE_OK;
}

static void set_range(double range[2], double low, double high)
{
    range[0] = low;
    range[1] = high;
}

static int set_ranges(const restitute_table_family *given, struct rst_family *f, restitute_error *error)
{
    const int no_gamma = isinf(given->gamma[0]) && given->gamma[0] > 0 && isinf(given->gamma[1]) && given->gamma[1] > 0;
    const int elastic = (given->delta1[0] == 0 && given->delta1[1] == 0) || no_gamma;
    const int kelvin_voigt = given->gamma[0] == 0 && given->gamma[1] == 0;
    int status = check_range(given->chi, "chi", 1.0 / 3, 1000, 3001, error);
    if (!status && !(given->delta1[0] == 0 && given->delta1[1] == 0))
        status = check_range(given->delta1, "delta1", DBL_MIN, 1e6, 1e12, error);
    if (!status && !kelvin_voigt && !no_gamma) status = check_range(given->gamma, "gamma", DBL_MIN, 1e6, 1e12, error);
    if (status) return status;
    f->sliding = RST_SLIDES;
    f->friction = NAN;
    set_range(f->asked[0], given->delta1[0], given->delta1[1]);
    set_range(f->asked[1], given->gamma[0], given->gamma[1]);
    set_range(f->asked[2], given->chi[0], given->chi[1]);
    set_range(f->range[0], elastic ? 0 : given->delta1[0], elastic ? 0 : given->delta1[1]);
    set_range(f->range[1], elastic ? INFINITY : given->gamma[0], elastic ? INFINITY : given->gamma[1]);
    set_range(f->range[2], given->chi[0], given->chi[1]);
    return RESTITUTE_OK;
}

static int copy_material(const restitute_material *material, restitute_material **copy, restitute_error *error)
{
    const size_t n = restitute_material_terms(material);
    double g_inf, eta, *term = malloc((2 * n + 1) * sizeof *term);
    if (!term) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for %zu terms", n);
    restitute_material_series(material, &g_inf, &eta, term, term + n);
    const int status = restitute_material_prony(g_inf, eta, n, term, term + n,
                                                restitute_material_poisson_ratio(material), copy, error);
    free(term);
    return status;
}

/* A spring alone, or a dashpot alone, gives the same pair at any speed. */
static int without_time(const restitute_material *material)
{
    double g_inf, eta;
    restitute_material_series(material, &g_inf, &eta, NULL, NULL);
    return restitute_material_terms(material) == 0 && (g_inf <= 0 || eta <= 0);
}

/* The scene at 1 m/s, sliding with 1 m/s at friction 1: psi is then what a unit of v_t/(mu v_n) gives. */
static int unit_numbers(const restitute_scene *scene, restitute_scene *unit, restitute_numbers *numbers,
                        restitute_error *error)
{
    *unit = *scene;
    unit->normal_speed = unit->tangential_speed = unit->friction = 1;
    unit->spin1 = unit->spin2 = 0;
    restitute_numbers_init(numbers);
    return restitute_scene_numbers(unit, numbers, error);
}

static int set_contact(const restitute_table_family *given, struct rst_family *f, restitute_error *error)
{
    restitute_scene plain;
    const restitute_scene *scene = given->scene;
    int status = check_range(given->speed, "speed (m/s)", rst_sizes.low, 1e12, 1e15, error);
    if (status) return status;
    if (scene->struct_size != sizeof *scene || !scene->material ||
        (scene->friction != 0 && !(scene->friction >= rst_least_friction))) {
        restitute_numbers numbers; /* the core says what is wrong */
        restitute_numbers_init(&numbers);
        status = restitute_scene_numbers(scene, &numbers, error);
        return status < 0 ? status : rst_report(error, RESTITUTE_ERROR_INTERNAL, "a scene was not refused");
    }
    status = unit_numbers(scene, &plain, &f->numbers, error);
    if (!status) status = copy_material(scene->material, &f->material, error);
    if (status) return status;
    f->scene = plain;
    f->scene.material = f->material;
    f->friction = scene->friction;
    f->sliding = scene->friction <= 0 ? RST_NO_FRICTION : isinf(scene->friction) ? RST_NEVER_SLIPS : RST_SLIDES;
    if (f->sliding != RST_SLIDES) f->scene.friction = scene->friction;
    set_range(f->asked[0], given->speed[0], given->speed[1]);
    set_range(f->asked[1], f->numbers.gamma, f->numbers.gamma);
    set_range(f->asked[2], f->numbers.chi, f->numbers.chi);
    const int no_axis = without_time(f->material);
    set_range(f->range[0], given->speed[0], no_axis ? given->speed[0] : given->speed[1]);
    set_range(f->range[1], 1, 1);
    set_range(f->range[2], f->numbers.chi, f->numbers.chi);
    return RESTITUTE_OK;
}

int rst_family_set(const restitute_table_family *given, struct rst_family *family, restitute_error *error)
{
    *family = (struct rst_family){.of_contact = given->scene != NULL};
    if (given->struct_size != sizeof *given)
        return rst_report(error, RESTITUTE_ERROR_STRUCT_SIZE,
                          "restitute_table_family.struct_size = %zu: must be %zu; prepare the struct with "
                          "restitute_table_family_init of this version",
                          given->struct_size, sizeof *given);
    const int status = given->scene ? set_contact(given, family, error) : set_ranges(given, family, error);
    if (status) rst_family_free(family);
    return status;
}

void rst_family_free(struct rst_family *family)
{
    restitute_material_destroy(family->material);
    family->material = NULL;
}

static double psi_factor(double unit, double friction)
{
    return friction <= 0 ? INFINITY : isinf(friction) ? 0 : unit / friction;
}

int rst_family_describe(const struct rst_family *f, restitute_table *form)
{
    memset(form, 0, sizeof *form);
    form->of_contact = f->of_contact;
    memcpy(form->asked, f->asked, sizeof form->asked);
    form->friction = form->radius = form->mass = form->poisson_ratio = form->duration = NAN;
    restitute_table_contact_init(&form->own);
    if (!f->of_contact) return RESTITUTE_OK;
    form->own.psi_factor = psi_factor(f->numbers.psi, f->friction);
    form->own.chi = f->numbers.chi;
    form->own.gamma = f->numbers.gamma;
    form->own.delta1 = f->numbers.delta1;
    form->duration = f->numbers.time;
    form->poisson_ratio = restitute_material_poisson_ratio(f->material);
    form->radius = f->numbers.radius;
    form->mass = f->numbers.mass;
    form->friction = f->friction;
    form->modulus_factor = f->scene.deformable == RESTITUTE_BOTH_BODIES_DEFORM ? 0.5 : 1;
    form->terms = (int64_t)restitute_material_terms(f->material);
    restitute_material_series(f->material, &form->equilibrium_modulus, &form->parallel_viscosity, NULL, NULL);
    return RESTITUTE_OK;
}

void rst_family_impact(const struct rst_family *f, double speed, double gamma, double chi, double psi,
                       restitute_impact *impact)
{
    (void)f;
    restitute_impact_init(impact);
    impact->chi = chi;
    impact->psi = psi;
    impact->delta1 = speed;
    impact->gamma = gamma;
}

void rst_family_scene(const struct rst_family *f, double speed, double psi, restitute_scene *scene)
{
    *scene = f->scene;
    scene->normal_speed = speed;
    scene->tangential_speed = f->sliding == RST_SLIDES ? psi * speed / f->numbers.psi : 0;
}

void restitute_table_contact_init(restitute_table_contact *contact)
{
    if (!contact) return;
    *contact = (restitute_table_contact){.struct_size = sizeof *contact, .speed_factor = 1};
}

/* Both are what the core computes from its material; chi of solid spheres comes by different sums. */
static int alike(double a, double b)
{
    const double rounding = 1e-12;
    return a == b || fabs(a - b) <= rounding * fmax(fabs(a), fabs(b));
}

static int same_material(const restitute_table *t, const restitute_material *material)
{
    double g_inf, eta;
    if (t->terms != (int64_t)restitute_material_terms(material)) return 0;
    if (!alike(t->poisson_ratio, restitute_material_poisson_ratio(material))) return 0;
    restitute_material_series(material, &g_inf, &eta, NULL, NULL);
    if (g_inf != t->equilibrium_modulus || eta != t->parallel_viscosity) return 0;
    if (t->terms == 0) return 1;
    double *term = malloc(2 * (size_t)t->terms * sizeof *term);
    if (!term) return -1;
    restitute_material_series(material, NULL, NULL, term, term + t->terms);
    const int same = memcmp(term, t->term, 2 * (size_t)t->terms * sizeof *term) == 0;
    free(term);
    return same;
}

/* The solid sees its own times over T, and T goes with v^(-1/5): a contact that is longer by f is one at f^-5 of the
 * speed. */
static int bind_own(const restitute_table *t, const restitute_scene *scene, const restitute_numbers *n,
                    restitute_table_contact *c, restitute_error *error)
{
    const int same = same_material(t, scene->material);
    if (same < 0) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory");
    if (!same) return rst_report(error, RESTITUTE_ERROR_DOMAIN, "scene.material: must be the one the table is for");
    const int with_chi = t->friction > 0 && scene->friction > 0;
    if (with_chi && !alike(n->chi, t->own.chi))
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "chi = %.17g of the scene: must be the table's, %.17g", n->chi,
                          t->own.chi);
    if (t->n_psi == 1 && scene->friction != t->friction && scene->friction > 0)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "friction = %g: must be %g, the only one of this table",
                          scene->friction, t->friction);
    const double largest_factor = 1e200; /* times the largest speed it does not overflow */
    const double ratio = t->duration / n->time, factor = ratio * ratio * ratio * ratio * ratio;
    if (t->speed.cells > 0 && !(factor <= largest_factor))
        return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                          "speed_factor = %g of the scene: must be <= %g; its mass and radius are too far from "
                          "those of the table's contact",
                          factor, largest_factor);
    c->speed_factor = t->speed.cells > 0 ? factor : 1;
    return RESTITUTE_OK;
}

/* What a table of ranges cannot tell: neither a number is there, nor a limit that it has. */
static int check_numbers(const restitute_numbers *n, restitute_error *error)
{
    if (!(n->gamma >= 0))
        return rst_report(
            error, RESTITUTE_ERROR_DOMAIN,
            "scene.material: must be a standard solid, a Kelvin-Voigt or an elastic one for a table of ranges");
    if (!(n->delta1 <= DBL_MAX))
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "delta1 = %g of the scene at 1 m/s: must be finite",
                          n->delta1);
    return RESTITUTE_OK;
}

int restitute_table_contact_of(const restitute_table *table, const restitute_scene *scene,
                               restitute_table_contact *contact, restitute_error *error)
{
    if (!table || !scene || !contact)
        return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", !table ? "table" : !scene ? "scene" : "contact");
    if (contact->struct_size != sizeof *contact)
        return rst_report(error, RESTITUTE_ERROR_STRUCT_SIZE,
                          "restitute_table_contact.struct_size = %zu: must be %zu; prepare the struct with "
                          "restitute_table_contact_init of this version",
                          contact->struct_size, sizeof *contact);
    restitute_scene with_friction = *scene, unit;
    restitute_numbers numbers;
    with_friction.normal_speed = 1;
    with_friction.tangential_speed = with_friction.spin1 = with_friction.spin2 = 0;
    restitute_numbers_init(&numbers);
    int status = restitute_scene_numbers(&with_friction, &numbers, error); /* refuses what is wrong with it */
    if (!status) status = unit_numbers(scene, &unit, &numbers, error);
    if (status) return status;
    restitute_table_contact found;
    restitute_table_contact_init(&found);
    found.psi_factor = psi_factor(numbers.psi, scene->friction);
    found.chi = numbers.chi;
    found.gamma = numbers.gamma;
    found.delta1 = numbers.delta1;
    if (table->of_contact)
        status = bind_own(table, scene, &numbers, &found, error);
    else
        status = check_numbers(&numbers, error);
    if (status) return status;
    *contact = found;
    return rst_done(error);
}
