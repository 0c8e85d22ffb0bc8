/* A user's DEM code, in C++: a contact that is pressed pushes back. Exit status 0 if it does.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <cstdio>
#include <vector>

#include <restitute/contact.h>

int main()
{
    restitute_material *rubber = nullptr;
    restitute_contact_law *law = nullptr;
    restitute_contact_rates rates;
    restitute_contact_motion motion;
    restitute_contact_force force = {};
    restitute_error error = {};
    restitute_contact_rates_init(&rates);
    restitute_contact_motion_init(&motion);
    if (restitute_material_standard_solid(1e6, 3e6, 300.0, 0.5, &rubber, &error) < 0 ||
        restitute_contact_law_create(rubber, nullptr, &law, &error) < 0 ||
        restitute_contact_rates_set(law, 1e-6, &rates, &error) < 0) {
        std::fprintf(stderr, "%s\n", error.message);
        return 1;
    }
    std::vector<double> state(restitute_contact_law_state_size(law), 0.0);
    motion.radius = 0.005;
    motion.velocity[2] = 0.1;
    for (int i = 1; i <= 10; i++) {
        motion.overlap = 1e-7 * i;
        if (restitute_contact_step(law, &rates, &motion, state.data(), &force, &error) < 0) {
            std::fprintf(stderr, "%s\n", error.message);
            return 1;
        }
    }
    std::printf("%g N\n", force.normal);
    restitute_contact_law_destroy(law);
    restitute_material_destroy(rubber);
    return !(force.normal > 0);
}
