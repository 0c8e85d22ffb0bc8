/* Tables in files. The input changes bytes of a good file, cuts it, or is the file; its checksum is
 * mostly made right. Then look-ups with any numbers in what was read.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <restitute/table_files.h>

#include "../support/bytes.h"
#include "../support/checksum.h"
#include "../support/table.h"
#include "fuzz.h"

enum { block = 512, most = 1 << 16 };

static uint8_t good[most];
static size_t good_size;

static void make_good_file(void)
{
    restitute_material *material;
    const restitute_scene scene = ball_on(1, &material);
    restitute_table *table = table_of(&scene, 0.1, 0.2, 0.05);
    CHECK(CALL_FLAGS(restitute_table_write, table, "fuzz.h5") == 0, "%s", fuzz_error.message);
    good_size = read_bytes("fuzz.h5", good, most);
    CHECK(good_size > block, "%zu bytes", good_size);
    restitute_table_destroy(table);
    restitute_material_destroy(material);
}

static size_t make_file(struct bytes *b, uint8_t *file)
{
    size_t size = good_size;
    const int kind = below(b, 8), changes = below(b, 8);
    memcpy(file, good, good_size);
    for (int i = 0; i < changes && kind != 1; i++) {
        const double value = signed_number(b, 1e-3, 1e3);
        const uint64_t count = take(b, 3);
        const size_t at = take(b, 2) % (size - sizeof value);
        if (below(b, 2))
            memcpy(file + at / 8 * 8, &value, sizeof value); /* numbers stand at multiples of 8 */
        else
            memcpy(file + at / 8 * 8, &count, sizeof count);
    }
    if (kind == 3) file[take(b, 1)] = (uint8_t)('0' + below(b, 10)); /* of a place */
    if (kind == 0) size = take(b, 2) % size;
    if (kind == 1) memcpy(file, b->at, size = b->left < most ? b->left : most);
    if (size > block && kind != 2 && file[block - 1] == 0 && strstr((char *)file, "checksum ") &&
        strstr((char *)file, "values at"))
        set_checksum(file, size);
    return size;
}

static void look_up_any(const restitute_table *table, struct bytes *b)
{
    enum { n = 3 };
    double normal[n], sliding[n], ez[n] = {7, 7, 7}, ex[n] = {7, 7, 7}, one[2];
    PREPARED(table_info, info);
    PREPARED(table_contact, contact);
    CHECK(CALL(restitute_table_describe, table, &info) == 0, "%s", fuzz_error.message);
    contact.speed_factor = number(b, 1e-3, 1e3);
    contact.psi_factor = number(b, 1e-3, 1e3);
    contact.radius = number(b, 1e-3, 1);
    contact.mass = number(b, 1e-3, 1);
    restitute_table_contact *kept = sized(b, &contact), *given = below(b, 2) ? NULL : kept;
    for (int i = 0; i < n; i++) {
        normal[i] = number(b, 1e-4, 1e2);
        sliding[i] = signed_number(b, 1e-4, 1e2);
    }
    /* a contact that restitute_table_contact_set did not fill may overflow, but gives a pair */
    const int status = CALL_IF(!given, restitute_table_pair_many, table, given, n, normal, sliding, ez, ex);
    for (int i = 0; i < n; i++) {
        int flags = 0;
        if (status == RESTITUTE_OK)
            CHECK(is_pair(ez[i], ex[i]), "pair %.17g, %.17g", ez[i], ex[i]);
        else
            CHECK(ez[i] == 7 && ex[i] == 7, "a failed look-up wrote");
        if (CALL_FLAGS(restitute_table_pair, table, given, normal[i], sliding[i], &one[0], &one[1]) == RESTITUTE_OK)
            CHECK(is_pair(one[0], one[1]), "pair %.17g, %.17g", one[0], one[1]);
        CHECK(status < 0 || (one[0] == ez[i] && one[1] == ex[i]), "%g of many, %g alone", ez[i], one[0]);
        CALL_IF(!given, restitute_table_flags, table, given, normal[i], sliding[i], &flags);
        CHECK(flags >= 0 && flags < 32, "flags %d", flags);
    }
    free(kept);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static uint8_t file[most];
    struct bytes b = {data, size};
    restitute_table *table = NULL;
    if (!good_size) make_good_file();
    size = make_file(&b, file);
    write_bytes("fuzz.h5", file, size);
    const int status = CALL(restitute_table_read, "fuzz.h5", &table);
    CHECK((status < 0) == !table, "status %d", status);
    if (table) look_up_any(table, &b);
    restitute_table_destroy(table);
    return 0;
}
