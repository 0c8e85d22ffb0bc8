/* Rows as HDF5.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "rows_hdf5.h"

#ifdef RESTITUTE_WITH_HDF5
#include <math.h>
#include <stdlib.h>

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

/* Numbers if all cells that are not empty are. */
static bool write_cells(hid_t file, const struct cases *cases, size_t column, const json_t *record)
{
    const char *name = cases_name(cases, column);
    const char **words = allocate(cases->rows, sizeof *words);
    double *numbers = allocate(cases->rows, sizeof *numbers);
    bool numeric = true, good;
    for (size_t i = 0; i < cases->rows; i++) {
        words[i] = cases_cell(cases, i, column);
        numbers[i] = NAN;
        if (*words[i] && restitute_number_read(words[i], &numbers[i]) != RESTITUTE_OK) numeric = false;
    }
    const hid_t word = H5Tcopy(H5T_C_S1);
    H5Tset_size(word, H5T_VARIABLE);
    if (numeric)
        good = hdf5_write_column(file, name, unit_of(record, name), H5T_NATIVE_DOUBLE, numbers, cases->rows);
    else
        good = hdf5_write_column(file, name, "", word, words, cases->rows);
    H5Tclose(word);
    free(words);
    free(numbers);
    return good;
}

static bool write_numbers(hid_t file, const struct cases *cases, const struct row *rows, size_t number,
                          const json_t *record)
{
    const char *name = row_number_name(number);
    double *numbers = allocate(cases->rows, sizeof *numbers);
    for (size_t i = 0; i < cases->rows; i++)
        numbers[i] = rows[i].solved ? rows[i].number[number] : NAN;
    const bool good = hdf5_write_column(file, name, unit_of(record, name), H5T_NATIVE_DOUBLE, numbers, cases->rows);
    free(numbers);
    return good;
}

static bool write_status(hid_t file, const struct cases *cases, const struct row *rows)
{
    const char **words = allocate(cases->rows, sizeof *words);
    const hid_t word = H5Tcopy(H5T_C_S1);
    H5Tset_size(word, H5T_VARIABLE);
    for (size_t i = 0; i < cases->rows; i++)
        words[i] = rows[i].status;
    const bool good = hdf5_write_column(file, "status", "", word, words, cases->rows);
    H5Tclose(word);
    free(words);
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
    for (size_t i = 0; i < cases->columns && good; i++)
        good = write_cells(file, cases, i, record);
    for (size_t i = 0; i < ROW_NUMBERS && good; i++)
        good = write_numbers(file, cases, rows, i, record);
    good = good && write_status(file, cases, rows);
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
