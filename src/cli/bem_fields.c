/* --fields of `restitute history`. The figure shows the snapshot in the middle of the contact.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "bem_fields.h"

#include <stdlib.h>
#include <string.h>

#include "file_form.h"
#include "gnuplot.h"
#include "output.h"

#ifdef RESTITUTE_WITH_BEM
#include <restitute/bem.h>

#ifdef RESTITUTE_WITH_HDF5
#include <stdio.h>

#include "hdf5_text.h"
#endif

enum { snapshots = 9 };

static bool check_place(const char *path, struct reason *why)
{
    const enum file_form form = file_form_of(path);
    if (form == FORM_HDF5) {
#ifndef RESTITUTE_WITH_HDF5
        return refuse(why, "--fields = %.200s: HDF5 is not in this build; .svg and .png are", path);
#endif
        return output_check(path, "--fields", why);
    }
    if (form != FORM_SVG && form != FORM_PNG)
        return refuse(why, "--fields = %.200s: must end in .h5, .hdf5, .svg or .png", path);
    return output_check(path, "--fields", why) && gnuplot_check(path, why);
}

bool bem_fields_begin(const struct settings *settings, restitute_options *options, struct bem_fields_keeper **keeper,
                      struct reason *why)
{
    restitute_bem_recorder *recorder;
    restitute_error error;
    const char *path = settings->text[TEXT_FIELDS];
    *keeper = NULL;
    if (!path) return true;
    if (options->method != restitute_method_bem()) return refuse(why, "--fields = %.200s: needs --method bem", path);
    if (!check_place(path, why)) return false;
    if (restitute_bem_recorder_create(snapshots, &recorder, &error) < 0) return refuse(why, "%s", error.message);
    options->method = restitute_bem_recorder_method(recorder);
    *keeper = (struct bem_fields_keeper *)recorder;
    return true;
}

void bem_fields_release(struct bem_fields_keeper *keeper)
{
    restitute_bem_recorder_destroy((restitute_bem_recorder *)keeper);
}

#ifdef RESTITUTE_WITH_HDF5
/* Values of all snapshots under one name, `rank` dimensions. */
static bool write_array(hid_t file, const char *name, int rank, const hsize_t *shape, const double *values)
{
    const hid_t space = H5Screate_simple(rank, shape, NULL);
    const hid_t set = hdf5_create_set(file, name, H5T_IEEE_F64LE, space);
    const bool good = set >= 0 && H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0;
    if (set >= 0) H5Dclose(set);
    H5Sclose(space);
    return good;
}

static bool fill_file(hid_t file, const restitute_bem_recorder *recorder)
{
    const size_t count = restitute_bem_recorder_count(recorder);
    double times[snapshots], spacing = 0;
    size_t cells = 0;
    restitute_bem_snapshot shot;
    restitute_bem_snapshot_init(&shot);
    for (size_t i = 0; i < count; i++) {
        restitute_bem_recorder_get(recorder, i, &shot, NULL);
        times[i] = shot.time, spacing = shot.spacing, cells = shot.cells;
    }
    const size_t grid = cells * cells;
    double *fields = allocate(3 * grid * count + 1, sizeof *fields);
    for (size_t i = 0; i < count; i++) {
        restitute_bem_recorder_get(recorder, i, &shot, NULL);
        memcpy(fields + i * grid, shot.pressure, grid * sizeof *fields);
        memcpy(fields + (count + i) * grid, shot.traction, grid * sizeof *fields);
        memcpy(fields + (2 * count + i) * grid, shot.stick, grid * sizeof *fields);
    }
    const hsize_t shape[3] = {count, cells, cells}, one = 1;
    const bool good = hdf5_write_text(file, "version", restitute_version()) &&
                      hdf5_write_text(file, "units",
                                      "time: T; spacing: a_el; pressure: G_r d0/a_el; traction: that times "
                                      "friction; stick: 1 sticks, 0 does not; axes: time, y, x") &&
                      write_array(file, "time", 1, shape, times) && write_array(file, "spacing", 1, &one, &spacing) &&
                      write_array(file, "pressure", 3, shape, fields) &&
                      write_array(file, "traction", 3, shape, fields + count * grid) &&
                      write_array(file, "stick", 3, shape, fields + 2 * count * grid);
    free(fields);
    return good;
}

static bool write_hdf5(const char *path, const restitute_bem_recorder *recorder, struct reason *why)
{
    struct output output;
    if (!output_open(path, &output, why)) return false;
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL); /* messages are ours */
    const hid_t file = rst_image_create(0);
    const bool good = file >= 0 && fill_file(file, recorder);
    if (hdf5_finish(file, good, output.stream)) return output_finish(&output, why);
    outputs_abandon(&output, 1);
    return refuse(why, "--fields = %.200s: cannot be made as HDF5", path);
}
#endif

static void send_matrix(const restitute_bem_snapshot *shot, const double *values, FILE *commands)
{
    for (size_t j = 0; j < shot->cells; j++)
        for (size_t i = 0; i < shot->cells; i++)
            fprintf(commands, "%.4g%c", values[j * shot->cells + i], i + 1 < shot->cells ? ' ' : '\n');
    fputs("e\n", commands);
}

static bool draw(const char *path, const restitute_bem_recorder *recorder, struct reason *why)
{
    static const char *const titles[] = {"pressure, G d_0/a_{el}", "traction over friction, same unit", "sticks"};
    struct gnuplot gnuplot;
    restitute_bem_snapshot shot;
    restitute_bem_snapshot_init(&shot);
    restitute_bem_recorder_get(recorder, restitute_bem_recorder_count(recorder) / 2, &shot, NULL);
    const double *const values[] = {shot.pressure, shot.traction, shot.stick};
    if (!gnuplot_open(path, 1000, 340, &gnuplot, why)) return false;
    fprintf(gnuplot.commands,
            "set multiplot layout 1,3 title 'x and y in a_{el}, t = %.4g T'\nset size ratio -1\nset tics 0.5\nset "
            "cbtics auto\nunset key\n"
            "set palette defined (0 '#ffffff', 1 '#3b518b', 2 '#21908d', 3 '#fde725')\n",
            shot.time);
    for (int i = 0; i < 3; i++) {
        fprintf(gnuplot.commands, "set title '%s'\nset xrange [%g:%g]\nset yrange [%g:%g]\n", titles[i],
                -shot.spacing * (double)shot.cells / 2, shot.spacing * (double)shot.cells / 2,
                -shot.spacing * (double)shot.cells / 2, shot.spacing * (double)shot.cells / 2);
        fprintf(gnuplot.commands, "plot '-' matrix using (($1 - %zu + 0.5)*%g):(($2 - %zu + 0.5)*%g):3 with image\n",
                shot.cells / 2, shot.spacing, shot.cells / 2, shot.spacing);
        send_matrix(&shot, values[i], gnuplot.commands);
    }
    fputs("unset multiplot\n", gnuplot.commands);
    return gnuplot_close(&gnuplot, why);
}

bool bem_fields_write(const struct settings *settings, struct bem_fields_keeper *keeper, struct reason *why)
{
    const restitute_bem_recorder *recorder = (const restitute_bem_recorder *)keeper;
    const char *path = settings->text[TEXT_FIELDS];
    if (!recorder) return true;
    if (restitute_bem_recorder_count(recorder) == 0) return refuse(why, "--fields: the impact has too few steps");
#ifdef RESTITUTE_WITH_HDF5
    if (file_form_of(path) == FORM_HDF5) return write_hdf5(path, recorder, why);
#endif
    return draw(path, recorder, why);
}

#else

bool bem_fields_begin(const struct settings *settings, restitute_options *options, struct bem_fields_keeper **keeper,
                      struct reason *why)
{
    (void)options;
    *keeper = NULL;
    return settings->text[TEXT_FIELDS] ? refuse(why, "--fields: the component bem is not in this build") : true;
}

bool bem_fields_write(const struct settings *settings, struct bem_fields_keeper *keeper, struct reason *why)
{
    (void)settings, (void)keeper, (void)why;
    return true;
}

void bem_fields_release(struct bem_fields_keeper *keeper)
{
    (void)keeper;
}

#endif
