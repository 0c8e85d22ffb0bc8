/* Columns by a plan: all impacts of a column share their normal motion.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "table/column.h"

#include <math.h>

/* Ten times the work of an impact whose slip needs elements, on a solid of up to `usual_terms`
 * terms; more in proportion. One that hardly rebounds may need more. Then its estimated error is
 * above the tolerance. */
static const double most_work = 0.01, usual_terms = 30; /* nominal seconds */

static int unit_numbers(const restitute_scene *scene, restitute_scene *unit, restitute_numbers *numbers,
                        restitute_error *error)
{
    *unit = *scene;
    unit->normal_speed = unit->tangential_speed = unit->friction = 1;
    unit->spin1 = unit->spin2 = 0;
    restitute_numbers_init(numbers);
    return restitute_scene_numbers(unit, numbers, error);
}

/* A solid of a spring alone or a dashpot alone has the same pair at any speed. */
static int without_time(const restitute_material *material)
{
    double g_inf, eta;
    restitute_material_series(material, &g_inf, &eta, NULL, NULL, NULL);
    return restitute_material_terms(material) == 0 && (g_inf <= 0 || eta <= 0);
}

int rst_contact_set(const restitute_scene *scene, struct rst_contact *contact, restitute_error *error)
{
    restitute_scene plain;
    int status = RST_TAKE(scene, &plain, scene, error);
    if (status) return status;
    plain.normal_speed = 1;
    plain.tangential_speed = plain.spin1 = plain.spin2 = 0;
    restitute_numbers_init(&contact->numbers);
    status = restitute_scene_numbers(&plain, &contact->numbers, error); /* refuses what is wrong with it */
    if (!status) status = unit_numbers(&plain, &contact->scene, &contact->numbers, error);
    if (status) return status;
    contact->friction = plain.friction;
    if (!rst_has_psi(contact)) contact->scene.friction = plain.friction;
    contact->timeless = without_time(plain.material);
    return RESTITUTE_OK;
}

double rst_psi_factor(const struct rst_contact *c)
{
    return c->friction <= 0 ? INFINITY : isinf(c->friction) ? 0 : c->numbers.psi / c->friction;
}

void rst_column_solver_init(const struct rst_contact *contact, const restitute_table_options *build, double tolerance,
                            struct rst_column_solver *s)
{
    *s = (struct rst_column_solver){.contact = contact, .build = build};
    restitute_options_init(&s->options);
    s->options.method = restitute_method_sync();
    s->options.tolerance = fmax(1e-8, tolerance);
    s->options.max_work = most_work * fmax(1, (double)restitute_material_terms(contact->scene.material) / usual_terms);
    s->options.time_limit = INFINITY; /* a clock would make tables differ */
}

/* A status < 0, with the speed of the column in the message. */
static int name_place(double speed, double psi, const restitute_error *why, restitute_error *error)
{
    if (rst_column_is_too_hard(why->status))
        return rst_report(
            error, why->status,
            "speed (m/s) = %g, psi = %g: too much work, or a rebound that is lost in rounding; raise the "
            "tolerance, or lower the upper end of speed",
            speed, psi);
    return rst_report(error, why->status, "speed (m/s) = %g, psi = %g: %.160s", speed, psi, why->message);
}

int rst_column_begin(struct rst_column_solver *s, double speed, restitute_error *error)
{
    restitute_scene scene = s->contact->scene;
    restitute_error why;
    restitute_plan *plan;
    if (s->build->interrupted && s->build->interrupted(s->build->interrupted_data))
        return rst_report(error, RESTITUTE_ERROR_INTERRUPTED, "%s",
                          restitute_status_text(RESTITUTE_ERROR_INTERRUPTED));
    scene.normal_speed = speed;
    const int status = restitute_plan_create_scene(&scene, &s->options, &plan, &why);
    if (status < 0) return name_place(speed, 0, &why, error);
    restitute_plan_destroy(s->plan);
    s->plan = plan;
    s->speed = speed;
    return RESTITUTE_OK;
}

static int solve(struct rst_column_solver *s, double psi, restitute_result *result, restitute_error *error)
{
    const struct rst_contact *c = s->contact;
    restitute_error why;
    restitute_result_init(result);
    const double sliding = rst_has_psi(c) ? psi * s->speed / c->numbers.psi : 0;
    const int status = restitute_plan_solve(s->plan, sliding, result, NULL, NULL, &why);
    if (status < 0) return name_place(s->speed, psi, &why, error);
    return status;
}

int rst_column_normal(struct rst_column_solver *s, struct rst_column_normal *normal, restitute_error *error)
{
    restitute_result r;
    const int status = solve(s, 0, &r, error);
    if (status < 0) return status;
    *normal = (struct rst_column_normal){
        r.ez,
        r.error_ez,
        {r.speed_ratio, r.radius_ratio, r.max_indentation / r.max_contact_radius, r.contact_time},
        status == RESTITUTE_NO_REBOUND};
    return RESTITUTE_OK;
}

int rst_column_solve(struct rst_column_solver *s, double psi, double *ex, double *error_ex, restitute_error *error)
{
    restitute_result r;
    const int status = solve(s, psi, &r, error);
    if (status < 0) return status;
    *ex = r.ex;
    *error_ex = r.error_ex;
    return RESTITUTE_OK;
}
