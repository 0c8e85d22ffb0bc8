/* Materials from .json and .csv files: the content is checked key by key, then passed to the core.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <errno.h>
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include <restitute/files.h>

#include "base/report.h"
#include "base/sized.h"
#include "files/file_text.h"
#include "files/json_place.h"
#include "files/json_values.h"
#include "files/measured.h"
#include "files/prony_terms.h"

/* The content of a file, before it becomes a material. */
struct material_content {
    restitute_material_info info;
    double poisson_ratio;
    double number[6]; /* indexed by enum number_key */
};

enum number_key { MODULUS, MODULUS1, MODULUS2, VISCOSITY, EQUILIBRIUM_MODULUS, PARALLEL_VISCOSITY };

static const struct {
    const char *key;
    int zero_allowed;
} number_keys[] = {{"modulus_pa", 0},
                   {"modulus1_pa", 0},
                   {"modulus2_pa", 0},
                   {"viscosity_pa_s", 0},
                   {"equilibrium_modulus_pa", 1},
                   {"parallel_viscosity_pa_s", 1}};

#define BIT(key) (1u << (key))
static const struct model {
    const char *name;
    unsigned required, optional; /* bits of enum number_key */
    int has_terms;
} models[] = {
    {"elastic", BIT(MODULUS), 0, 0},
    {"standard_solid", BIT(MODULUS1) | BIT(MODULUS2) | BIT(VISCOSITY), 0, 0},
    {"kelvin_voigt", BIT(MODULUS1) | BIT(VISCOSITY), 0, 0},
    {"maxwell", BIT(MODULUS) | BIT(VISCOSITY), 0, 0},
    {"prony", 0, BIT(EQUILIBRIUM_MODULUS) | BIT(PARALLEL_VISCOSITY), 1},
};
enum { MODEL_COUNT = sizeof models / sizeof models[0], NUMBER_COUNT = sizeof number_keys / sizeof number_keys[0] };

RST_DEFAULTS(material_info, .density = NAN, .temperature = NAN, .wlf_c1 = NAN, .wlf_c2 = NAN, .wlf_reference = NAN,
             .wlf_range = {-INFINITY, INFINITY}, .window = {0, INFINITY}, .viscosity = NAN)

static int read_poisson_ratio(const struct json_file *file, double *poisson_ratio)
{
    const int status = rst_json_number(file, file->root, "poisson_ratio", 0, 1, poisson_ratio);
    if (status != RESTITUTE_OK || (*poisson_ratio >= 0 && *poisson_ratio <= 0.5)) return status;
    return rst_report(file->error, RESTITUTE_ERROR_DOMAIN, "%s line %zu: poisson_ratio = %.15g: must be in [0, 0.5]",
                      file->name, rst_json_line_of_key(file->text, "poisson_ratio"), *poisson_ratio);
}

static const struct model *find_model(const struct json_file *file, const char *name)
{
    for (int i = 0; i < MODEL_COUNT; i++)
        if (strcmp(models[i].name, name) == 0) return &models[i];
    rst_report(file->error, RESTITUTE_ERROR_FORMAT,
               "%s line %zu: model = \"%s\": must be elastic, standard_solid, "
               "kelvin_voigt, maxwell or prony",
               file->name, rst_json_line_of_key(file->text, "model"), name);
    return NULL;
}

/* Keys of this model beside the numbers. */
static const char *words_of(const struct model *model)
{
    return model->has_terms ? "name, source, model, poisson_ratio, density_kg_m3, terms, prony_csv"
                            : "name, source, model, poisson_ratio, density_kg_m3";
}

static int has_number(const struct model *model, int number)
{
    return ((model->required | model->optional) & BIT(number)) != 0;
}

static int is_allowed(const struct model *model, const char *key)
{
    const size_t length = strlen(key);
    for (const char *word = words_of(model); word; word = strchr(word, ',') ? strchr(word, ',') + 2 : NULL)
        if (length == strcspn(word, ",") && strncmp(key, word, length) == 0) return 1;
    for (int i = 0; i < NUMBER_COUNT; i++)
        if (strcmp(key, number_keys[i].key) == 0) return has_number(model, i);
    return rst_is_measured_key(key);
}

/* ", modulus_pa, ..." */
static const char *numbers_of(const struct model *model, char *text, size_t size)
{
    text[0] = '\0';
    for (int i = 0; i < NUMBER_COUNT; i++)
        if (has_number(model, i)) snprintf(text + strlen(text), size - strlen(text), ", %s", number_keys[i].key);
    return text;
}

static int refuse_unknown_keys(const struct json_file *file, const struct model *model)
{
    const char *key;
    json_t *value;
    json_object_foreach(file->root, key, value)
    {
        char numbers[100];
        if (!is_allowed(model, key))
            return rst_report(file->error, RESTITUTE_ERROR_FORMAT,
                              "%s line %zu: unknown key \"%.32s\" for model %s: must be among %s%s, " RST_MEASURED_KEYS,
                              file->name, rst_json_line_of_key(file->text, key), key, model->name, words_of(model),
                              numbers_of(model, numbers, sizeof numbers));
    }
    return RESTITUTE_OK;
}

/* One object of "terms": exactly tau_s and modulus_pa. */
static int read_term(const struct json_file *file, const json_t *term, size_t line, double *time, double *modulus)
{
    if (!json_is_object(term))
        return rst_report(file->error, RESTITUTE_ERROR_FORMAT,
                          "%s line %zu: each of \"terms\" must be an object "
                          "{\"tau_s\": .., \"modulus_pa\": ..}",
                          file->name, line);
    const char *key;
    json_t *value;
    json_object_foreach((json_t *)term, key, value)
    {
        if (strcmp(key, "tau_s") != 0 && strcmp(key, "modulus_pa") != 0)
            return rst_report(file->error, RESTITUTE_ERROR_FORMAT, "%s line %zu: unknown key \"%.64s\" in a term",
                              file->name, line, key);
    }
    const int status = rst_json_number(file, term, "tau_s", line, 1, time);
    return status == RESTITUTE_OK ? rst_json_number(file, term, "modulus_pa", line, 1, modulus) : status;
}

static int read_term_list(const struct json_file *file, const json_t *list, struct prony_terms *terms)
{
    const size_t line = rst_json_line_of_key(file->text, "terms");
    if (!json_is_array(list) || json_array_size(list) == 0)
        return rst_report(file->error, RESTITUTE_ERROR_FORMAT,
                          "%s line %zu: \"terms\" must be an array of at least one "
                          "{\"tau_s\": .., \"modulus_pa\": ..}",
                          file->name, line);
    int status = rst_prony_terms_allocate(json_array_size(list), terms, file->error);
    if (status != RESTITUTE_OK) return status;
    rst_json_lines_of_items(file->text, "terms", terms->line, terms->count);
    for (size_t i = 0; i < terms->count && status == RESTITUTE_OK; i++)
        status =
            read_term(file, json_array_get(list, i), terms->line[i], &terms->relaxation_time[i], &terms->modulus[i]);
    if (status == RESTITUTE_OK) status = rst_prony_terms_check(terms, file->name, "tau_s", "modulus_pa", file->error);
    if (status != RESTITUTE_OK) rst_prony_terms_release(terms);
    return status;
}

/* The CSV beside the JSON file: its folder, then the name given. */
static char *path_beside(const char *path, const char *name)
{
    const char *slash = strrchr(path, '/');
    const size_t folder = slash && *name != '/' ? (size_t)(slash - path) + 1 : 0;
    const char *here = strcmp(name, "-") == 0 ? "./" : ""; /* a bare "-" would be the standard input */
    char *joined = malloc(folder + strlen(here) + strlen(name) + 1);
    if (joined) {
        memcpy(joined, path, folder);
        strcpy(joined + folder, here);
        strcat(joined, name);
    }
    return joined;
}

static int read_terms(struct json_file *file, struct prony_terms *terms)
{
    const json_t *list = json_object_get(file->root, "terms");
    if (!list == !json_object_get(file->root, "prony_csv"))
        return rst_report(file->error, RESTITUTE_ERROR_FORMAT,
                          "%s: model prony needs either \"terms\" or \"prony_csv\"%s", file->name,
                          list ? ", not both" : "");
    if (list) return read_term_list(file, list, terms);
    char name[1024];
    int status = rst_json_copy_text(file, "prony_csv", 1, name, sizeof name);
    if (status != RESTITUTE_OK) return status;
    char *path = path_beside(file->path, name);
    if (!path) return rst_report(file->error, RESTITUTE_ERROR_MEMORY, "%s: out of memory", file->name);
    uint64_t fingerprint;
    status = rst_prony_terms_read_csv(path, terms, &fingerprint, file->error);
    if (status == RESTITUTE_OK) file->fingerprint ^= fingerprint;
    free(path);
    return status;
}

static int read_content(const struct json_file *file, struct material_content *content, const struct model **model)
{
    restitute_material_info *info = &content->info;
    int status = rst_json_copy_text(file, "model", 1, info->model, sizeof info->model);
    if (status == RESTITUTE_OK && !(*model = find_model(file, info->model))) status = RESTITUTE_ERROR_FORMAT;
    if (status == RESTITUTE_OK) status = refuse_unknown_keys(file, *model);
    if (status == RESTITUTE_OK) status = rst_json_copy_text(file, "name", 1, info->name, sizeof info->name);
    if (status == RESTITUTE_OK) status = rst_json_copy_text(file, "source", 0, info->source, sizeof info->source);
    if (status == RESTITUTE_OK) status = read_poisson_ratio(file, &content->poisson_ratio);
    if (status == RESTITUTE_OK) status = rst_json_positive(file, "density_kg_m3", 0, 0, &info->density);
    if (status == RESTITUTE_OK) status = rst_read_measured(file, info);
    for (int i = 0; i < NUMBER_COUNT && status == RESTITUTE_OK; i++)
        status = rst_json_positive(file, number_keys[i].key, ((*model)->required & BIT(i)) != 0,
                                   number_keys[i].zero_allowed, &content->number[i]);
    return status;
}

static int create_prony(struct json_file *file, const struct material_content *content, restitute_material **material,
                        restitute_error *why)
{
    struct prony_terms terms;
    int status = read_terms(file, &terms);
    if (status != RESTITUTE_OK) {
        why->message[0] = '\0'; /* already reported in file->error */
        return status;
    }
    status =
        restitute_material_prony(content->number[EQUILIBRIUM_MODULUS], content->number[PARALLEL_VISCOSITY], terms.count,
                                 terms.relaxation_time, terms.modulus, content->poisson_ratio, material, why);
    rst_prony_terms_release(&terms);
    return status;
}

/* The library may still refuse combinations, such as tau = viscosity/modulus2 beyond a double. */
static int create_material(struct json_file *file, const struct model *model, const struct material_content *content,
                           restitute_material **material)
{
    const double *number = content->number, nu = content->poisson_ratio;
    restitute_error why;
    int status;
    if (model->has_terms)
        status = create_prony(file, content, material, &why);
    else if (strcmp(model->name, "elastic") == 0)
        status = restitute_material_elastic(number[MODULUS], nu, material, &why);
    else if (strcmp(model->name, "standard_solid") == 0)
        status = restitute_material_standard_solid(number[MODULUS1], number[MODULUS2], number[VISCOSITY], nu, material,
                                                   &why);
    else if (strcmp(model->name, "kelvin_voigt") == 0)
        status = restitute_material_kelvin_voigt(number[MODULUS1], number[VISCOSITY], nu, material, &why);
    else
        status = restitute_material_maxwell(number[MODULUS], number[VISCOSITY], nu, material, &why);
    if (status < 0 && why.message[0] != '\0') return rst_report(file->error, status, "%s: %s", file->name, why.message);
    return status < 0 ? status : rst_done(file->error);
}

static int material_from_root(struct json_file *file, restitute_material **material, restitute_material_info *info)
{
    if (!json_is_object(file->root))
        return rst_report(file->error, RESTITUTE_ERROR_FORMAT, "%s: must be one JSON object, { .. }", file->name);
    struct material_content content = {.poisson_ratio = NAN};
    restitute_material_info_init(&content.info);
    const struct model *model = NULL;
    int status = read_content(file, &content, &model);
    if (status == RESTITUTE_OK) status = create_material(file, model, &content, material);
    if (status != RESTITUTE_OK) return status;
    restitute_material_set_window(*material, content.info.window[0], content.info.window[1], NULL); /* checked */
    *info = content.info;
    info->fingerprint = file->fingerprint;
    return status;
}

static int read_json_material(const char *path, restitute_material **material, restitute_material_info *info,
                              restitute_error *error)
{
    struct file_text text;
    int status = rst_file_text_read(path, &text, error);
    if (status != RESTITUTE_OK) return status;
    json_error_t reason;
    struct json_file file = {path, rst_file_name_for_message(path), text.bytes, NULL, 0, error};
    file.fingerprint = rst_file_text_fingerprint(&text);
    errno = 0; /* if memory runs out, Jansson reports nothing, or a syntax error */
    const size_t mark = strncmp(text.bytes, "\xef\xbb\xbf", 3) == 0 ? 3 : 0; /* of byte order, by Windows */
    file.root =
        json_loadb(text.bytes + mark, text.length - mark, JSON_REJECT_DUPLICATES | JSON_DECODE_INT_AS_REAL, &reason);
    if (file.root)
        status = material_from_root(&file, material, info);
    else if (errno == ENOMEM || reason.text[0] == '\0')
        status = rst_report(error, RESTITUTE_ERROR_MEMORY, "%s: out of memory", file.name);
    else
        status = rst_report(error, RESTITUTE_ERROR_FORMAT, "%s line %d column %d: not JSON: %.120s", file.name,
                            reason.line, reason.column, reason.text);
    json_decref(file.root);
    free(text.bytes);
    return status;
}

static int read_csv_material(const char *path, restitute_material **material, restitute_material_info *info,
                             restitute_error *error)
{
    struct prony_terms terms;
    uint64_t fingerprint;
    restitute_error why;
    int status = rst_prony_terms_read_csv(path, &terms, &fingerprint, error);
    if (status != RESTITUTE_OK) return status;
    status = restitute_material_prony(0.0, 0.0, terms.count, terms.relaxation_time, terms.modulus, 0.5, material, &why);
    rst_prony_terms_release(&terms);
    if (status != RESTITUTE_OK)
        return rst_report(error, status, "%s: %s", rst_file_name_for_message(path), why.message);
    const char *slash = strrchr(path, '/');
    snprintf(info->name, sizeof info->name, "%.127s", slash ? slash + 1 : path);
    snprintf(info->model, sizeof info->model, "prony");
    info->fingerprint = fingerprint;
    return rst_done(error);
}

int restitute_material_read(const char *path, restitute_material **material, restitute_material_info *info,
                            restitute_error *error)
{
    restitute_material_info own;
    restitute_material *made = NULL;
    int status = RESTITUTE_OK;
    if (!path || !material) return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", path ? "material" : "path");
    if (info && (status = RST_CHECK(material_info, info, error))) return status;
    restitute_material_info_init(&own);
    const char *extension = strrchr(path, '.');
    if (extension && strcasecmp(extension, ".json") == 0)
        status = read_json_material(path, &made, &own, error);
    else if (extension && strcasecmp(extension, ".csv") == 0)
        status = read_csv_material(path, &made, &own, error);
    else
        status = rst_report(error, RESTITUTE_ERROR_FORMAT, "%s: a material file must end in .json or .csv",
                            rst_file_name_for_message(path));
    if (status == RESTITUTE_OK) status = rst_viscosity_of(made, &own.viscosity, error);
    if (status != RESTITUTE_OK) {
        restitute_material_destroy(made);
        return status;
    }
    if (info) RST_GIVE(&own, info);
    *material = made;
    return RESTITUTE_OK;
}
