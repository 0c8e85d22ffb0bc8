/* Rows as HDF5.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "rows_hdf5.h"

#ifdef RESTITUTE_WITH_HDF5
#include <math.h>
#include <stdlib.h>

#include "files/number.h"
#include "hdf5_text.h"
#include "output.h"

bool rows_hdf5_built(void)
{
    return true;
}

static const char *unit_of(const json_t *record, const char *name)
{
    const char *unit = json_string_value(json_object_get(json_object_get(record, "units"), name));
    return unit ? unit : "";
}

static bool write_words(hid_t file, const char *name, const char *const *words, size_t count)
{
    const hid_t word = H5Tcopy(H5T_C_S1);
    H5Tset_size(word, H5T_VARIABLE);
    const bool good = hdf5_write_column(file, name, "", word, words, count);
    H5Tclose(word);
    return good;
}

/* Column `column` of the cases, then the numbers of the rows, then their status. Numbers if all cells that are not
 * empty are. */
static bool write_column(hid_t file, const struct cases *cases, const struct row *rows, size_t column,
                         const json_t *record)
{
    const size_t number = column - cases->columns;
    const bool input = column < cases->columns, status = !input && number == ROW_NUMBERS;
    const char *name = status ? "status" : row_column_name(cases, column);
    const char **words = allocate(cases->rows, sizeof *words);
    double *numbers = allocate(cases->rows, sizeof *numbers);
    bool numeric = !status;
    for (size_t i = 0; i < cases->rows; i++) {
        words[i] = input ? cases_cell(cases, i, column) : rows[i].status;
        numbers[i] = !input && !status && rows[i].solved ? rows[i].number[number] : NAN;
        if (input && *words[i] && rst_number_read(words[i], &numbers[i]) != RESTITUTE_OK) numeric = false;
    }
    const bool good =
        numeric ? hdf5_write_column(file, name, unit_of(record, name), H5T_NATIVE_DOUBLE, numbers, cases->rows)
                : write_words(file, name, words, cases->rows);
    free(words);
    free(numbers);
    return good;
}

bool rows_hdf5_write(const char *path, const struct cases *cases, const struct row *rows, const json_t *record,
                     struct reason *why)
{
    struct output output;
    if (!output_open(path, &output, why)) return false;
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL); /* messages are ours */
    const hid_t file = rst_image_create(0);
    char *text = json_dumps(record, JSON_INDENT(2) | JSON_REAL_PRECISION(17));
    bool good = file >= 0 && text && hdf5_write_text(file, "record", text);
    for (size_t i = 0; i < cases->columns + ROW_NUMBERS + 1 && good; i++)
        good = write_column(file, cases, rows, i, record);
    free(text);
    if (hdf5_finish(file, good, output.stream)) return output_finish(&output, why);
    outputs_abandon(&output, 1);
    return refuse(why, "%.200s: cannot be made as HDF5", path);
}
#else
bool rows_hdf5_built(void)
{
    return false;
}

/* Never reached: rows_hdf5_built() is asked before. */
bool rows_hdf5_write(const char *path, const struct cases *cases, const struct row *rows, const json_t *record,
                     struct reason *why)
{
    (void)cases, (void)rows, (void)record;
    return refuse(why, "%.200s: HDF5 is not in this build", path);
}
#endif
