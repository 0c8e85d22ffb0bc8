/* The options of `restitute fit`.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fit_settings.h"

enum { CODE_TENSION = CODE_HELP + 1 };

const char *const fit_models[] = {"elastic", "kelvin_voigt", "standard_solid", "maxwell", "prony", NULL};

#define TEXT(which, name, argument, help) OPTION((name), CODE_TEXT + (which), (argument), (help))

static const struct poptOption own_options[] = {
    TEXT(FIT_INPUT, "input", "DROP.csv", "measured impacts, one a row, columns by name"),
    TEXT(FIT_DMA, "dma", "CURVE.csv", "instead: storage and loss modulus over frequency"),
    TEXT(FIT_PARTNER, "partner", "rigid|same|FILE",
         "one of the two bodies deforms (default), both do and are of the solid, or the partner's material"),
    TEXT(FIT_MODEL, "model", "NAME", "elastic, kelvin_voigt, standard_solid (default), maxwell or prony"),
    TEXT(FIT_TERMS, "terms", "TAU,...", "relaxation times of the model prony, s, 1 to 20"),
    TEXT(FIT_KNOWN, "known", "NAME=VALUE,...",
         "constants that are not fitted: modulus1, modulus2, modulus, viscosity; "
         "equilibrium, term1, term2, ..."),
    TEXT(FIT_LOSS, "loss", "squares|huber|cauchy", "how large residuals count; default squares"),
    TEXT(FIT_CONFIDENCE, "confidence", "P", "of the intervals, in [0.5, 0.999]; default 0.95"),
    TEXT(FIT_REFERENCE, "reference-temperature", "T", "in C, of the constants; default that of the first row"),
    TEXT(FIT_WLF, "wlf", "C1:C2", "shifts of times by temperature; default: a free shift a temperature"),
    TEXT(FIT_NOISE, "noise", "RATIO", "with --dma: relative error of the moduli, in [1e-4, 0.5]; default 0.01"),
    OPTION_FLAG("tension", CODE_TENSION, "with --dma: the moduli are those of tension"),
    TEXT(FIT_STARTS, "starts", "N", "local fits, 1 to 100; default 5, or 8 where residuals are large"),
    TEXT(FIT_SEED, "seed", "N", "of the scan for starts; default 1"),
    TEXT(FIT_THREADS, "threads", "N", "1 to 1024; default 1, all processors from 200 rows on"),
    TEXT(FIT_NAME, "name", "TEXT", "name in the material file; default the input's"),
    TEXT(FIT_OUTPUT, "output", "FILE.json", "the material file, and all numbers in FILE.json.meta.json"),
    TEXT(FIT_FIGURE, "figure", "FILE", "data, fit and residuals, .svg, .png or .pdf; needs gnuplot"),
    OPTION_HELP,
    POPT_TABLEEND};

static const char footer[] =
    "\n  restitute fit --input drop.csv --radius 0.01 --density 7800 --output rubber.json --figure rubber.svg\n"
    "  restitute fit --dma curve.csv --output rubber.json\n"
    "\nColumns of DROP.csv: ez, or rebound_height_m; speed_m_s, or drop_height_m; and optional ex, angle_deg,\n"
    "contact_time_s, temperature_C, weight, sigma_ez, sigma_ex, sigma_contact_time_s, friction, partner, radius1_m,\n"
    "mass1_kg, density1_kg_m3 and the others of restitute pair. With ex and without friction, friction is fitted.\n"
    "Columns of CURVE.csv: frequency_Hz, storage_Pa, loss_Pa and optional temperature_C.\n"
    "\nExit status: 0 done, 1 done, but the data do not follow the model or leave constants open (remarks say which),\n"
    "2 bad usage or input, nothing written, 130 interrupted.\n";

static bool of_scene(enum field field)
{
    return field > FIELD_LAST_DIMENSIONLESS && (field <= FIELD_FRICTION || field == FIELD_POISSON) &&
           field != FIELD_SPEED;
}

/* The place of a word in a list, from `first` on. */
static bool word(const char *option, const char *text, const char *const *words, int first, int *value,
                 struct reason *why)
{
    char all[120] = "";
    if (!text) return true;
    for (int i = 0; words[i]; i++) {
        if (strcmp(text, words[i]) == 0) {
            *value = first + i;
            return true;
        }
        snprintf(all + strlen(all), sizeof all - strlen(all), "%s%s", i ? ", " : "", words[i]);
    }
    return refuse(why, "--%s = \"%.64s\": must be one of %s", option, text, all);
}

/* "1e-4,1e-3" into the relaxation times. */
static bool read_terms(struct fit_settings *s, struct reason *why)
{
    char *list = s->text[FIT_TERMS] ? copy_of(s->text[FIT_TERMS]) : NULL, *rest = NULL;
    bool good = (s->options.model == RESTITUTE_FIT_MODEL_PRONY) == (list != NULL) ||
                refuse(why, "--terms and --model prony belong together");
    for (char *item = list ? strtok_r(list, ",", &rest) : NULL; item && good; item = strtok_r(NULL, ",", &rest))
        good = s->options.terms < 20
                   ? option_number("terms", item, 1e-30, 1e30, false, &s->terms[s->options.terms++], why)
                   : refuse(why, "--terms: more than 20 relaxation times");
    free(list);
    return good;
}

/* The place of a constant in the model. */
static int constant_place(const restitute_fit_options *o, const char *name)
{
    static const char *const names[][4] = {[RESTITUTE_FIT_MODEL_ELASTIC] = {"modulus"},
                                           [RESTITUTE_FIT_MODEL_KELVIN_VOIGT] = {"modulus1", "viscosity"},
                                           [RESTITUTE_FIT_MODEL_STANDARD_SOLID] = {"modulus1", "modulus2", "viscosity"},
                                           [RESTITUTE_FIT_MODEL_MAXWELL] = {"modulus", "viscosity"},
                                           [RESTITUTE_FIT_MODEL_PRONY] = {"equilibrium"}};
    int term;
    char more;
    for (int i = 0; i < 4 && names[o->model][i]; i++)
        if (strcmp(names[o->model][i], name) == 0) return i;
    return sscanf(name, "term%d%c", &term, &more) == 1 && term >= 1 && term <= (int)o->terms ? term : -1;
}

static bool read_known(struct fit_settings *s, struct reason *why)
{
    char *list = s->text[FIT_KNOWN] ? copy_of(s->text[FIT_KNOWN]) : NULL, *rest = NULL;
    bool good = true;
    for (int i = 0; i < RESTITUTE_FIT_CONSTANTS; i++)
        s->known[i] = NAN;
    for (char *item = list ? strtok_r(list, ",", &rest) : NULL; item && good; item = strtok_r(NULL, ",", &rest)) {
        char *equals = strchr(item, '=');
        if (equals) *equals = '\0';
        const int place = constant_place(&s->options, item);
        if (!equals || place < 0)
            good = refuse(why, "--known: \"%.40s\" is no NAME=VALUE of a constant of this model; see --help", item);
        else if (!isnan(s->known[place]))
            good = refuse(why, "--known: %s is given twice", item);
        else
            good = option_number("known", equals + 1, s->options.model == RESTITUTE_FIT_MODEL_PRONY ? 0 : 1e-30, 1e30,
                                 false, &s->known[place], why);
    }
    free(list);
    s->options.known = s->known;
    return good;
}

static bool read_wlf(struct fit_settings *s, struct reason *why)
{
    const char *text = s->text[FIT_WLF], *colon = text ? strchr(text, ':') : NULL;
    char first[64];
    if (!text) return true;
    snprintf(first, sizeof first, "%.*s", colon ? (int)(colon - text) : 0, text);
    if (!colon || !option_number("wlf", first, 0, 1e6, false, &s->options.wlf_c1, why) ||
        !option_number("wlf", colon + 1, 1e-6, 1e6, false, &s->options.wlf_c2, why))
        return refuse(why, "--wlf = \"%.64s\": must be C1:C2, two positive numbers", text);
    return true;
}

static const char *text_name(int code)
{
    const struct poptOption *o = own_options;
    while (o->val != code)
        o++;
    return o->longName;
}

/* Options of the other kind of input would be passed over without a word. */
static bool check_kind(const struct fit_settings *s, struct reason *why)
{
    if (!s->text[FIT_INPUT] == !s->text[FIT_DMA])
        return refuse(why, "give --input, measured impacts, or --dma, a curve of moduli; see --help");
    if (!s->text[FIT_DMA] && (s->tension || s->text[FIT_NOISE])) return refuse(why, "--tension, --noise: need --dma");
    for (int i = FIT_PARTNER; s->text[FIT_DMA] && i <= FIT_THREADS; i++)
        if (s->text[i]) return refuse(why, "--%s: not with --dma", text_name(CODE_TEXT + i));
    for (enum field field = 0; s->text[FIT_DMA] && field < FIELD_COUNT; field++)
        if (s->values.given[field] && field != FIELD_POISSON)
            return refuse(why, "--%s: not with --dma", field_rules[field].option);
    return true;
}

/* Texts into the options of the library. */
static bool take_texts(struct fit_settings *s, struct reason *why)
{
    static const char *const losses[] = {"squares", "huber", "cauchy", NULL};
    restitute_fit_options *o = &s->options;
    double starts = o->starts, seed = (double)o->seed, threads = -1;
    const bool good = word("model", s->text[FIT_MODEL], fit_models, RESTITUTE_FIT_MODEL_ELASTIC, &o->model, why) &&
                      word("loss", s->text[FIT_LOSS], losses, RESTITUTE_FIT_LOSS_SQUARES, &o->loss, why) &&
                      read_terms(s, why) && read_known(s, why) && read_wlf(s, why) &&
                      option_number("confidence", s->text[FIT_CONFIDENCE], 0.5, 0.999, false, &o->confidence, why) &&
                      option_number("reference-temperature", s->text[FIT_REFERENCE], -273.15, 1e4, false,
                                    &o->reference_temperature, why) &&
                      option_number("noise", s->text[FIT_NOISE], 1e-4, 0.5, false, &s->dma.noise, why) &&
                      option_number("starts", s->text[FIT_STARTS], 1, 100, true, &starts, why) &&
                      option_number("seed", s->text[FIT_SEED], 0, 4294967295.0, true, &seed, why) &&
                      option_number("threads", s->text[FIT_THREADS], 1, 1024, true, &threads, why);
    if (!good) return false;
    o->relaxation_time = s->terms, o->starts = (int)starts, o->seed = (uint64_t)seed, o->threads = (int)threads;
    if (s->values.given[FIELD_POISSON]) o->poisson_ratio = s->dma.poisson_ratio = s->values.number[FIELD_POISSON];
    s->dma.reference_temperature = o->reference_temperature, s->dma.wlf_c1 = o->wlf_c1, s->dma.wlf_c2 = o->wlf_c2;
    s->dma.tension = s->tension;
    return !s->text[FIT_PARTNER] || partner_read(s->text[FIT_PARTNER], "--partner", &s->values, why);
}

static bool read_arguments(poptContext context, struct fit_settings *s, bool *help, struct reason *why)
{
    int code;
    while ((code = poptGetNextOpt(context)) > 0) {
        bool good = true;
        if (code == CODE_HELP) return *help = true;
        if (code == CODE_TENSION)
            s->tension = true;
        else if (code >= CODE_TEXT)
            good = option_keep(text_name(code), &s->text[code - CODE_TEXT], poptGetOptArg(context), why);
        else
            good = option_keep(field_rules[code - CODE_FIELD].option, &s->field[code - CODE_FIELD],
                               poptGetOptArg(context), why);
        if (!good) return false;
    }
    return arguments_end(context, code, NULL, why) && values_read(s->field, &s->values, why) && check_kind(s, why) &&
           take_texts(s, why);
}

enum reading fit_options_read(int count, char **arguments, struct fit_settings *settings)
{
    struct reason why;
    bool help = false;
    *settings = (struct fit_settings){.argument_count = count, .arguments = (const char *const *)arguments};
    settings->values = values_none();
    restitute_fit_options_init(&settings->options);
    restitute_dma_options_init(&settings->dma);
    struct poptOption *table = field_options(of_scene, own_options);
    struct arguments read = arguments_begin("restitute fit", 2, count, arguments, table);
    const bool good = read_arguments(read.context, settings, &help, &why);
    const enum reading reading = arguments_close(&read, good, help, footer, &why);
    free(table);
    return reading;
}

void fit_options_release(struct fit_settings *settings)
{
    for (int i = 0; i < FIT_TEXTS; i++)
        free(settings->text[i]);
    for (int i = 0; i < FIELD_COUNT; i++)
        free(settings->field[i]);
}
