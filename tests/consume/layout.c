/* The layout of every public struct as C sees it, one number after the other: its size, then the
 * offset of each member in the order of the header. layout.f90 compares them with Fortran's.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stddef.h>

#include <restitute/restitute.h>

enum { END = -1000 };
long long layout_value(int k);

#define AT(type, member) (long long)offsetof(restitute_##type, member)

static const long long layout[] = {
    (long long)sizeof(restitute_error), AT(error, status), AT(error, message),
    (long long)sizeof(restitute_impact), AT(impact, struct_size), AT(impact, chi), AT(impact, psi),
    AT(impact, delta1), AT(impact, gamma), AT(impact, solid),
    (long long)sizeof(restitute_scene), AT(scene, struct_size), AT(scene, material), AT(scene, deformable),
    AT(scene, radius1), AT(scene, mass1), AT(scene, radius2), AT(scene, mass2), AT(scene, inertia1),
    AT(scene, inertia2), AT(scene, rotation_blocked), AT(scene, friction), AT(scene, normal_speed),
    AT(scene, tangential_speed), AT(scene, spin1), AT(scene, spin2), AT(scene, density),
    (long long)sizeof(restitute_numbers), AT(numbers, struct_size), AT(numbers, chi), AT(numbers, psi),
    AT(numbers, delta1), AT(numbers, gamma), AT(numbers, delta2), AT(numbers, radius), AT(numbers, mass),
    AT(numbers, modulus), AT(numbers, length_z), AT(numbers, length_x), AT(numbers, time), AT(numbers, force),
    (long long)sizeof(restitute_options), AT(options, struct_size), AT(options, method), AT(options, tolerance),
    AT(options, elements), AT(options, time_step), AT(options, max_updates), AT(options, time_limit),
    AT(options, speed_limit), AT(options, radius_limit), AT(options, displacement_limit), AT(options, dundurs_limit),
    (long long)sizeof(restitute_result), AT(result, struct_size), AT(result, ez), AT(result, ex),
    AT(result, error_ez), AT(result, error_ex), AT(result, contact_time), AT(result, max_indentation),
    AT(result, max_contact_radius), AT(result, max_normal_force), AT(result, merging_bound), AT(result, terms_merged),
    AT(result, elements), AT(result, steps), AT(result, element_spacing), AT(result, time_step), AT(result, updates),
    AT(result, speed_ratio), AT(result, radius_ratio), AT(result, displacement_ratio), AT(result, dundurs_beta),
    AT(result, flags), AT(result, method),
    (long long)sizeof(restitute_ledger), AT(ledger, struct_size), AT(ledger, rebound_z), AT(ledger, viscous_z),
    AT(ledger, left_z), AT(ledger, residual_z), AT(ledger, rebound_x), AT(ledger, friction_x), AT(ledger, viscous_x),
    AT(ledger, left_x), AT(ledger, residual_x),
    (long long)sizeof(restitute_history), AT(history, struct_size), AT(history, capacity), AT(history, count),
    AT(history, time), AT(history, indentation), AT(history, contact_radius), AT(history, stick_radius),
    AT(history, normal_force), AT(history, tangential_force), AT(history, normal_velocity),
    AT(history, tangential_velocity),
    (long long)sizeof(restitute_body), AT(body, struct_size), AT(body, position), AT(body, velocity), AT(body, spin),
    AT(body, radius), AT(body, mass), AT(body, inertia), AT(body, normal),
    (long long)sizeof(restitute_contact), AT(contact, struct_size), AT(contact, material), AT(contact, deformable),
    AT(contact, friction), AT(contact, touch_gap), AT(contact, density),
    /* and the constants */
#define VALUE_OF_STATUS(name, value, text) RESTITUTE_##name,
    RESTITUTE_STATUS_LIST(VALUE_OF_STATUS)
#define VALUE_OF_FLAG(name, bit, text) RESTITUTE_FLAG_##name,
    RESTITUTE_FLAG_LIST(VALUE_OF_FLAG)
    RESTITUTE_ONE_BODY_DEFORMS, RESTITUTE_BOTH_BODIES_DEFORM,
};

/* Number k of the list; END behind the last. */
long long layout_value(int k)
{
    return k < (int)(sizeof layout / sizeof *layout) ? layout[k] : END;
}
