/* Materials by any name, at any temperature, in any window, of two bodies.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "materials.h"

static void by_name(struct bytes *b)
{
    static const char *const known[] = {"steel", "polyisobutylene", "steel.json", "../materials/steel", ""};
    char name[300] = "";
    restitute_material *material = NULL;
    PREPARED(material_info, info);
    const size_t length = take(b, 1);
    if (length < 5)
        strcpy(name, known[length]);
    else
        for (size_t i = 0; i < length; i++)
            name[i] = (char)take(b, 1);
    setenv("RESTITUTE_MATERIALS", RESTITUTE_SOURCE_DIR "/src/materials", 1);
    end_read(CALL(restitute_material_by_name, name, &material, &info), &material, &info, b, 1);
}

static void made_of(const restitute_material *one, const restitute_material *two, struct bytes *b)
{
    restitute_material *shifted = NULL, *both = NULL;
    PREPARED(material_info, info);
    double *const number_of[] = {&info.temperature, &info.wlf_c1, &info.wlf_c2, &info.wlf_reference};
    for (int i = 0; i < 4; i++)
        *number_of[i] = signed_number(b, 1e-2, 1e3);
    check_at(signed_number(b, 1, 1e3), one, &info);
    end_made(CALL(restitute_material_shifted, one, number(b, 1e-20, 1e20), &shifted), &shifted);
    const int status = CALL(restitute_material_effective, one, two, &both);
    if (status >= 0)
        CHECK(fabs(restitute_material_dundurs(both)) <= 0.5, "Dundurs' beta %g", restitute_material_dundurs(both));
    end_made(status, &both);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct bytes b = {data, size};
    if (below(&b, 8) == 0) {
        by_name(&b);
        return 0;
    }
    restitute_material *one = any_material(&b), *two = below(&b, 4) ? any_material(&b) : NULL;
    if (one) {
        const double shortest = number(&b, 1e-9, 1), longest = number(&b, 1e-6, 1e9);
        const int fits = shortest >= 0 && shortest < longest;
        CHECK((CALL(restitute_material_set_window, one, shortest, longest) == RESTITUTE_OK) == fits, "%g to %g s",
              shortest, longest);
        check_solid(one);
        made_of(one, two ? two : one, &b);
    }
    restitute_material_destroy(one);
    restitute_material_destroy(two);
    return 0;
}
