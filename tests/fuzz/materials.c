/* Materials by any name, at any temperature, in any window, of two bodies.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "materials.h"

static void by_name(struct bytes *b)
{
    static const char *const known[] = {"steel", "polyisobutylene", "steel.json", "../materials/steel", ""};
    char name[300] = "";
    restitute_material *material = NULL;
    restitute_material_info info;
    restitute_material_info_init(&info);
    const size_t length = take(b, 1);
    if (length < 5)
        strcpy(name, known[length]);
    else
        for (size_t i = 0; i < length; i++)
            name[i] = (char)take(b, 1);
    setenv("RESTITUTE_MATERIALS", RESTITUTE_SOURCE_DIR "/src/materials", 1);
    const int status = CALL(restitute_material_by_name, name, &material, &info);
    REQUIRE((status < 0) == !material, "status %d", status);
    if (material) {
        check_info(&info);
        check_solid(material);
        check_made(material, &info, signed_number(b, 1, 1e3));
    }
    restitute_material_destroy(material);
}

static void made(const restitute_material *one, const restitute_material *two, struct bytes *b)
{
    restitute_material *solid = NULL;
    restitute_material_info info;
    restitute_material_info_init(&info);
    double *const number_of[] = {&info.temperature, &info.wlf_c1, &info.wlf_c2, &info.wlf_reference};
    for (int i = 0; i < 4; i++)
        *number_of[i] = signed_number(b, 1e-2, 1e3);
    check_made(one, &info, signed_number(b, 1, 1e3));
    if (CALL(restitute_material_shifted, one, number(b, 1e-20, 1e20), &solid) == RESTITUTE_OK) check_solid(solid);
    REQUIRE((fuzz_error.status < 0) == !solid, "%s", fuzz_error.message);
    restitute_material_destroy(solid);
    solid = NULL;
    if (CALL(restitute_material_effective, one, two, &solid) == RESTITUTE_OK) {
        const double beta = restitute_material_dundurs(solid);
        check_solid(solid);
        REQUIRE(fabs(beta) <= 0.5, "Dundurs' beta %g", beta);
    }
    REQUIRE((fuzz_error.status < 0) == !solid, "%s", fuzz_error.message);
    restitute_material_destroy(solid);
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
        REQUIRE((CALL(restitute_material_set_window, one, shortest, longest) == RESTITUTE_OK) == fits, "%g to %g s",
                shortest, longest);
        check_solid(one);
        made(one, two ? two : one, &b);
    }
    restitute_material_destroy(one);
    restitute_material_destroy(two);
    return 0;
}
