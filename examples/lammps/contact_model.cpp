/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "contact_model.h"

#include <restitute/files.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <stdexcept>

namespace restitute_dem
{

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* ---- record */

void Record::add(const Record &other)
{
    steps += other.steps;
    contacts += other.contacts;
    for (int i = 0; i < RATIOS; i++) {
        beyond[i] += other.beyond[i];
        largest[i] = std::max(largest[i], other.largest[i]);
    }
}

std::string Record::text(const double limits[RATIOS]) const
{
    static const char *names[] = {"contact radius over radius", "speed over shear wave speed",
                                  "time step over the law's", "first overlap over 2 steps'"};
    char line[200];
    std::snprintf(line, sizeof line, "restitute: %.0f contacts, %.0f steps of contacts\n", contacts, steps);
    std::string all = line;
    for (int i = 0; i < RATIOS && steps > 0; i++) {
        std::snprintf(line, sizeof line, "restitute: %-27s largest %-9.3g contacts beyond %g: %.0f\n", names[i],
                      largest[i], limits[i], beyond[i]);
        all += line;
    }
    return all;
}

std::string Record::warning(Ratio which, long long step) const
{
    char line[200] = "";
    if (which == STEP && beyond[STEP] > 0)
        std::snprintf(line, sizeof line,
                      "restitute: a contact began at step %lld that needs a time step shorter by a factor of %.3g",
                      step, largest[STEP]);
    if (which == DEPTH && beyond[DEPTH] > 0)
        std::snprintf(line, sizeof line,
                      "restitute: a contact began at step %lld with %.3g times the overlap that two steps explain: "
                      "spheres were created with an overlap, or their contact was lost or found late",
                      step, largest[DEPTH]);
    return line;
}

void ContactModel::note(Ratio which, double ratio)
{
    record.largest[which] = std::max(record.largest[which], ratio);
    record.beyond[which] += ratio > limits[which];
}

/* Velocity Verlet moves bodies with the velocity at this call. So the first overlap is at most one
 * step of approach, or (v dt)^2/(8 R) for spheres that pass each other. 1e-5 R, a contact radius of
 * 0.003 R, covers that up to steps of 0.009 R. A larger tolerance would hide lost contacts of hard
 * spheres at rest. v/c_s as for one impact of the library: with the modulus at the time scale of
 * the impact. */
void ContactModel::note_first_touch(const restitute_contact_motion &contact, double density)
{
    const double speed = dot(contact.velocity, contact.normal);
    double limit; /* a fiftieth of the contact time, which is 2.9433 time scales */
    record.contacts++;
    note(DEPTH, contact.overlap / (2 * (rates.step * std::max(speed, 0.0) + drift) + 1e-5 * contact.radius));
    if (restitute_contact_time_step_limit(law, 1 / contact.inverse_mass, contact.radius, speed, &limit, nullptr) < 0)
        return; /* no speed of approach: bodies were put into each other */
    const double modulus = restitute_material_modulus(material, limit * 50 / 2.9433);
    note(SPEED, speed / std::sqrt(modulus / std::max(density, file_density)));
    note(STEP, rates.step / limit);
}

/* ---- words of a script */

static double number(const std::string &word)
{
    double value = NAN;
    const char *end = word.data() + word.size();
    const auto read = std::from_chars(word.data(), end, value); /* whatever the locale */
    if (read.ec != std::errc() || read.ptr != end || std::isnan(value))
        throw std::invalid_argument("'" + word + "': must be a number");
    return value;
}

static void demand(int status, const restitute_error &error)
{
    if (status < 0) throw std::invalid_argument(error.message);
}

ContactModel::ContactModel(const std::vector<std::string> &words, const Units &units) : words(words)
{
    restitute_contact_law_options options;
    std::string partner;
    restitute_contact_law_options_init(&options);
    restitute_contact_motion_init(&motion);
    restitute_contact_rates_init(&rates);
    try {
        read(units, options, partner);
        options.deformable = partner == "" ? RESTITUTE_BOTH_BODIES_DEFORM : RESTITUTE_ONE_BODY_DEFORMS;
        if (partner != "" && partner != "rigid") join(partner, units);
        demand(restitute_contact_law_create(material, &options, &law, &error), error);
        remark = error.message;
    } catch (...) {
        restitute_material_destroy(material);
        throw;
    }
}

ContactModel::~ContactModel()
{
    restitute_contact_law_destroy(law);
    restitute_material_destroy(material);
}

void ContactModel::read(const Units &units, restitute_contact_law_options &options, std::string &partner)
{
    size_t i = 0;
    const auto next = [&]() {
        if (++i >= words.size()) throw std::invalid_argument("'" + words[i - 1] + "': something must follow");
        return words[i];
    };
    if (words.empty()) throw std::invalid_argument("the file of a material is missing");
    for (motion.friction = -1, i = 1; i < words.size(); i++) {
        const std::string &word = words[i];
        if (word == "friction")
            motion.friction = number(next());
        else if (word == "partner")
            partner = next();
        else if (word == "elements")
            options.elements = (int)number(next());
        else if (word == "terms")
            options.terms = (int)number(next());
        else if (word == "window")
            options.shortest = number(next()), options.longest = number(next());
        else if (word == "limits")
            limits[RADIUS] = number(next()), limits[SPEED] = number(next());
        else
            throw std::invalid_argument("'" + word + "': must be friction, partner, elements, terms, window or limits");
    }
    if (!(motion.friction >= 0 && motion.friction <= 1e6))
        throw std::invalid_argument("'friction MU' is required, with MU in [0, 1e6]");
    options.frictionless = motion.friction == 0;
    open(words[0], units, &material);
}

/* A material in units of the host. */
void ContactModel::open(const std::string &file, const Units &units, restitute_material **opened)
{
    restitute_material *si;
    restitute_material_info info;
    double g_inf, eta;
    restitute_material_info_init(&info);
    demand(restitute_material_read(file.c_str(), &si, &info, &error), error);
    if (info.density > 0) file_density = std::max(file_density, info.density / units.density);
    const size_t n = restitute_material_terms(si);
    std::vector<double> tau(n + 1), g(n + 1);
    restitute_material_series(si, &g_inf, &eta, tau.data(), g.data(), nullptr);
    for (double &modulus : g)
        modulus /= units.stress;
    const int status = restitute_material_prony(g_inf / units.stress, eta / units.stress, n, tau.data(), g.data(),
                                                restitute_material_poisson_ratio(si), opened, &error);
    restitute_material_destroy(si);
    demand(status, error);
}

/* Makes one solid of the material and that of the partner. */
void ContactModel::join(const std::string &partner, const Units &units)
{
    restitute_material *other, *effective;
    open(partner, units, &other);
    const int status = restitute_material_effective(material, other, &effective, &error);
    restitute_material_destroy(other);
    demand(status, error);
    restitute_material_destroy(material);
    material = effective;
}

std::string ContactModel::about() const
{
    size_t kept;
    double bound;
    char text[200];
    restitute_contact_law_series(law, nullptr, nullptr, &kept, nullptr, nullptr, &bound, nullptr);
    std::snprintf(text, sizeof text, ": law %016llx, %zu of %zu terms, G(t) within %.2g %%, %d numbers a contact",
                  (unsigned long long)hash(), kept, restitute_material_terms(material), 100 * bound, history_size());
    const std::string warning = remark.empty() ? "" : "WARNING: restitute: " + words[0] + ": " + remark + "\n";
    return "restitute: " + words[0] + text + "\n" + warning;
}

uint64_t ContactModel::hash() const
{
    return restitute_contact_law_hash(law);
}

int ContactModel::history_size() const
{
    return 1 + (int)restitute_contact_law_state_size(law);
}

/* ---- time steps */

const char *ContactModel::set_step(double step)
{
    return restitute_contact_rates_set(law, step, &rates, &error) < 0 ? error.message : nullptr;
}

std::unique_ptr<Batch> ContactModel::make_batch() const
{
    auto batch = std::make_unique<Batch>();
    std::fill_n(batch->motion, Batch::SIZE, motion);
    return batch;
}

static void to_force(const restitute_contact_force &f, const double *normal, double force[3])
{
    for (int i = 0; i < 3; i++)
        force[i] = f.tangential[i] - f.normal * normal[i];
}

int ContactModel::advance(Batch &b, const char **problem)
{
    double *states[Batch::SIZE];
    restitute_contact_force found[Batch::SIZE];
    int status[Batch::SIZE];
    bool is_new[Batch::SIZE];
    for (int k = 0; k < b.n; k++) {
        states[k] = b.history[k] + 1;
        is_new[k] = b.history[k][0] == 0;
    }
    if (restitute_contact_step_many(law, &rates, b.n, b.motion, states, found, status, &error) < 0) {
        const char *its = std::strstr(error.message, ": "); /* after the number of the contact */
        *problem = its ? its + 2 : error.message;
        return (int)(std::find_if(status, status + b.n, [](int one) { return one < 0; }) - status);
    }
    for (int k = 0; k < b.n; k++)
        to_force(found[k], b.motion[k].normal, b.force[k]);
    note(b, is_new);
    return -1;
}

void ContactModel::note(Batch &b, const bool *is_new)
{
    const double limit = limits[RADIUS] * limits[RADIUS];
    double deepest = 0;
    for (int k = 0; k < b.n; k++) {
        double &label = b.history[k][0];
        if (is_new[k]) label = b.label[k];
        if (!b.on_record[k]) continue;
        record.steps++;
        if (is_new[k]) note_first_touch(b.motion[k], b.density[k]);
        const double depth = b.motion[k].overlap / b.motion[k].radius; /* = (a/R)^2 */
        deepest = std::max(deepest, depth);
        if (depth > limit && label > 0) {
            label = -label;
            record.beyond[RADIUS]++;
        }
    }
    record.largest[RADIUS] = std::max(record.largest[RADIUS], std::sqrt(deepest));
}

int ContactModel::repeat(Batch &b, const char **problem)
{
    restitute_contact_force found;
    for (int k = 0; k < b.n; k++) {
        *problem = error.message;
        if (restitute_contact_peek(law, b.motion[k].normal, b.history[k] + 1, &found, &error) < 0) return k;
        to_force(found, b.motion[k].normal, b.force[k]);
    }
    return -1;
}

const char *ContactModel::turn(const double from[3], const double to[3], double *history)
{
    return restitute_contact_turn(law, from, to, history + 1, &error) < 0 ? error.message : nullptr;
}

} // namespace restitute_dem
