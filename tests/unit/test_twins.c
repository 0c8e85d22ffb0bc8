/* Structs of C and their twins, the derived types of Fortran: members begin at the same places.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../support/check.h"
#ifdef RESTITUTE_WITH_CVODE
#include "cvode/kernels.h"
#endif
#include "euler/kernels.h"
#include "sync/kernels.h"

/* unit/twins.F90. */
void fortran_offsets(int64_t i, int64_t *n, int64_t *offset);

struct member {
    const char *name;
    size_t offset, size;
};

/* A member; the end of the struct. */
#define AT(type, member)                                                                                               \
    {                                                                                                                  \
#member, offsetof(struct type, member), sizeof((struct type *)0)->member                                       \
    }
#define END(type)                                                                                                      \
    {                                                                                                                  \
        "end", sizeof(struct type), 0                                                                                  \
    }

enum { most_members = 40 };

/* In the order of unit/twins.F90. */
static const struct {
    const char *name;
    struct member member[most_members];
} structs[] = {
    [0] = {"rst_chain", {AT(rst_chain, m_inf), AT(rst_chain, eta), AT(rst_chain, n), END(rst_chain)}},
    [1] = {"rst_ledger",
           {AT(rst_ledger, viscous_z), AT(rst_ledger, left_z), AT(rst_ledger, friction_x), AT(rst_ledger, viscous_x),
            AT(rst_ledger, left_x), END(rst_ledger)}},
    [2] = {"euler_scene",
           {AT(euler_scene, chi), AT(euler_scene, shear_speed), AT(euler_scene, g_inf), AT(euler_scene, eta),
            AT(euler_scene, step), AT(euler_scene, spacing), AT(euler_scene, rest_speed), AT(euler_scene, n_terms),
            AT(euler_scene, capacity), AT(euler_scene, can_sink), AT(euler_scene, keep_ledger), AT(euler_scene, mode),
            END(euler_scene)}},
    [3] = {"euler_state",
           {AT(euler_state, time),
            AT(euler_state, depth),
            AT(euler_state, velocity),
            AT(euler_state, shift),
            AT(euler_state, shear_velocity),
            AT(euler_state, force),
            AT(euler_state, shear_force),
            AT(euler_state, true_edge_force),
            AT(euler_state, true_edge_shear),
            AT(euler_state, centre_force),
            AT(euler_state, leave_time),
            AT(euler_state, max_depth),
            AT(euler_state, max_force),
            AT(euler_state, max_time),
            AT(euler_state, n_contact),
            AT(euler_state, max_contact),
            AT(euler_state, phase),
            AT(euler_state, mode),
            AT(euler_state, n_steps),
            AT(euler_state, n_updates),
            AT(euler_state, n_stalled),
            AT(euler_state, ledger),
            END(euler_state)}},
    [4] = {"sync_panel",
           {AT(sync_panel, from), AT(sync_panel, to), AT(sync_panel, radius), AT(sync_panel, time),
            AT(sync_panel, depth), AT(sync_panel, velocity), AT(sync_panel, force), AT(sync_panel, pace),
            END(sync_panel)}},
    [5] = {"sync_normal_control",
           {AT(sync_normal_control, roughness), AT(sync_normal_control, stop_speed), AT(sync_normal_control, halvings),
            AT(sync_normal_control, capacity), AT(sync_normal_control, n_coarse),
            AT(sync_normal_control, n_coarse_compression), AT(sync_normal_control, coarse), END(sync_normal_control)}},
    [6] = {"sync_normal",
           {AT(sync_normal, eta), AT(sync_normal, scale), AT(sync_normal, closeness), AT(sync_normal, residual_speed),
            AT(sync_normal, n_arms), AT(sync_normal, n_compression), AT(sync_normal, n_panels), AT(sync_normal, g),
            AT(sync_normal, rate), AT(sync_normal, panel), AT(sync_normal, memory), AT(sync_normal, loading),
            AT(sync_normal, kernel), AT(sync_normal, entry), END(sync_normal)}},
    [7] = {"sync_contact",
           {AT(sync_contact, chi), AT(sync_contact, psi), AT(sync_contact, roughness), AT(sync_contact, noise),
            AT(sync_contact, closeness), AT(sync_contact, stress), AT(sync_contact, mode), END(sync_contact)}},
    [8] = {"sync_record", {AT(sync_record, from), AT(sync_record, to), AT(sync_record, touch), END(sync_record)}},
    [9] = {"sync_piece",
           {AT(sync_piece, panel), AT(sync_piece, rooted), AT(sync_piece, from), AT(sync_piece, to),
            AT(sync_piece, shear_velocity), AT(sync_piece, shear_force), AT(sync_piece, stick_radius),
            END(sync_piece)}},
    [10] = {"sync_store",
            {AT(sync_store, capacity), AT(sync_store, n_records), AT(sync_store, n_pieces), AT(sync_store, n_trials),
             AT(sync_store, record), AT(sync_store, piece), AT(sync_store, corrective), AT(sync_store, room),
             END(sync_store)}},
    [11] = {"walk",
            {AT(walk, n), AT(walk, n_terms), AT(walk, capacity), AT(walk, start), AT(walk, end), AT(walk, mode),
             AT(walk, prescribed), AT(walk, divides), AT(walk, chi), AT(walk, psi), AT(walk, g_inf), AT(walk, eta),
             END(walk)}},
    [12] = {"walk_level",
            {AT(walk_level, step), AT(walk_level, radius), AT(walk_level, depth), AT(walk_level, velocity),
             AT(walk_level, force), END(walk_level)}},
    [13] = {"walk_shear", {AT(walk_shear, velocity), AT(walk_shear, force), END(walk_shear)}},
    [14] = {"walk_term",
            {AT(walk_term, g), AT(walk_term, decay), AT(walk_term, from_start), AT(walk_term, from_end),
             AT(walk_term, normal), END(walk_term)}},
#ifdef RESTITUTE_WITH_CVODE
    [15] = {"cvode_scene",
            {AT(cvode_scene, chi), AT(cvode_scene, g_inf), AT(cvode_scene, eta), AT(cvode_scene, reference),
             AT(cvode_scene, step_start), AT(cvode_scene, n_terms), AT(cvode_scene, n_modes), AT(cvode_scene, n_states),
             AT(cvode_scene, n_knots), AT(cvode_scene, n_nodes), AT(cvode_scene, n_entered),
             AT(cvode_scene, restitution), AT(cvode_scene, mode), END(cvode_scene)}},
    [16] = {"cvode_contact",
            {AT(cvode_contact, square), AT(cvode_contact, radius), AT(cvode_contact, force), END(cvode_contact)}},
    [17] = {"cvode_sums",
            {AT(cvode_sums, force), AT(cvode_sums, stick), AT(cvode_sums, backward), AT(cvode_sums, n_contact),
             END(cvode_sums)}},
    [18] = {"element_energy",
            {AT(element_energy, f), AT(element_energy, q), AT(element_energy, viscous_z), AT(element_energy, viscous_x),
             AT(element_energy, held_z), AT(element_energy, held_x), AT(element_energy, motion), END(element_energy)}},
#endif
};

static void members_begin_where_those_of_their_twin_do(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof structs / sizeof *structs; i++) {
        const struct member *m = structs[i].member;
        int64_t n = 0, offset[most_members];
        if (!structs[i].name) continue; /* of a component that is not built */
        fortran_offsets((int64_t)i, &n, offset);
        CHECK(n > 1 && n <= most_members, "%s: Fortran has %d offsets", structs[i].name, (int)n);
        for (int64_t k = 0; k < n; k++)
            CHECK(m[k].name && m[k].offset == (size_t)offset[k], "%s.%s: at %zu in C, at %zu in Fortran",
                  structs[i].name, m[k].name ? m[k].name : "?", m[k].offset, (size_t)offset[k]);
        CHECK(!m[n].name, "%s.%s: not in Fortran", structs[i].name, m[n].name);
    }
}

/* No member is forgotten here: each begins where the one before it ends. */
static void all_members_are_listed(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof structs / sizeof *structs; i++) {
        size_t end = 0;
        for (const struct member *m = structs[i].member; m->name; end = m->offset + m->size, m++)
            CHECK(m->offset == end, "%s.%s: at %zu, but those before it end at %zu", structs[i].name, m->name,
                  m->offset, end);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(members_begin_where_those_of_their_twin_do),
        cmocka_unit_test(all_members_are_listed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
