/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "contact_model.h"

#include <restitute/files.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace restitute_dem
{

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

bool touching(const Body &first, const Body &second, Contact &c)
{
    const double *a = first.position, *b = second.position, *v = first.velocity, *w = second.velocity;
    const double x = b[0] - a[0], y = b[1] - a[1], z = b[2] - a[2], square = x * x + y * y + z * z;
    const double sum = first.radius + second.radius;
    c.inverse_mass = first.inverse_mass + second.inverse_mass;
    if (!(square < sum * sum) || square == 0 || c.inverse_mass == 0) return false;
    const double distance = std::sqrt(square), inverse = 1 / distance, n0 = x * inverse, n1 = y * inverse, n2 = z * inverse;
    c.overlap = sum - distance;
    c.arm1 = first.radius - 0.5 * c.overlap; /* the arms add up to the distance: angular momentum is conserved */
    c.arm2 = second.radius > 0 ? second.radius - 0.5 * c.overlap : 0;
    c.radius = second.radius > 0 ? first.radius * second.radius / sum : first.radius;
    const double turn0 = c.arm1 * first.spin[0] + c.arm2 * second.spin[0];
    const double turn1 = c.arm1 * first.spin[1] + c.arm2 * second.spin[1];
    const double turn2 = c.arm1 * first.spin[2] + c.arm2 * second.spin[2];
    c.normal[0] = n0, c.normal[1] = n1, c.normal[2] = n2;
    c.velocity[0] = v[0] - w[0] + turn1 * n2 - turn2 * n1;
    c.velocity[1] = v[1] - w[1] + turn2 * n0 - turn0 * n2;
    c.velocity[2] = v[2] - w[2] + turn0 * n1 - turn1 * n0;
    return true;
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
void ContactModel::note_first_touch(const Contact &contact, double speed, double density)
{
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

static void to_force(const restitute_contact_force &f, const double *normal, double force[3])
{
    for (int i = 0; i < 3; i++)
        force[i] = f.tangential[i] - f.normal * normal[i];
}

const char *ContactModel::advance(const Contact &contact, double density, bool on_record, double *history,
                                  double force[3], double label)
{
    const bool is_new = history[0] == 0;
    const double solid_sphere = 3.5; /* 1 + m R^2/J */
    restitute_contact_force found;
    motion.overlap = contact.overlap;
    std::copy_n(contact.normal, 3, motion.normal);
    std::copy_n(contact.velocity, 3, motion.velocity);
    motion.inverse_mass = contact.inverse_mass;
    motion.inverse_tangential_mass = solid_sphere * motion.inverse_mass;
    motion.radius = contact.radius;
    if (restitute_contact_step(law, &rates, &motion, history + 1, &found, &error) < 0) return error.message;
    to_force(found, contact.normal, force);
    if (is_new) history[0] = label;
    if (!on_record) return nullptr;
    record.steps++;
    if (is_new) note_first_touch(contact, dot(contact.velocity, contact.normal), density);
    const double largest = record.largest[RADIUS], limit = limits[RADIUS], depth = contact.overlap; /* = a^2/R */
    if (depth > largest * largest * contact.radius) record.largest[RADIUS] = std::sqrt(depth / contact.radius);
    if (depth > limit * limit * contact.radius && history[0] > 0) {
        history[0] = -history[0];
        record.beyond[RADIUS]++;
    }
    return nullptr;
}

const char *ContactModel::repeat(const Contact &contact, const double *history, double force[3])
{
    restitute_contact_force found;
    if (restitute_contact_peek(law, contact.normal, history + 1, &found, &error) < 0) return error.message;
    to_force(found, contact.normal, force);
    return nullptr;
}

const char *ContactModel::turn(const double from[3], const double to[3], double *history)
{
    return restitute_contact_turn(law, from, to, history + 1, &error) < 0 ? error.message : nullptr;
}

} // namespace restitute_dem
