/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "contact_model.h"

#include <restitute/files.h>

#include <algorithm>
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
    double *n = c.normal;
    const double sum = first.radius + second.radius;
    for (int i = 0; i < 3; i++)
        n[i] = second.position[i] - first.position[i];
    const double square = dot(n, n);
    c.inverse_mass = first.inverse_mass + second.inverse_mass;
    if (!(square < sum * sum) || square == 0 || c.inverse_mass == 0) return false;
    const double distance = std::sqrt(square);
    c.overlap = sum - distance;
    c.arm1 = first.radius - 0.5 * c.overlap; /* arms that add up to the distance keep the angular momentum */
    c.arm2 = second.radius > 0 ? second.radius - 0.5 * c.overlap : 0;
    c.radius = second.radius > 0 ? first.radius * second.radius / sum : first.radius;
    double turn[3];
    for (int i = 0; i < 3; i++) {
        n[i] /= distance;
        turn[i] = c.arm1 * first.spin[i] + (c.arm2 > 0 ? c.arm2 * second.spin[i] : 0);
    }
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        c.velocity[i] = first.velocity[i] - second.velocity[i] + turn[j] * n[k] - turn[k] * n[j];
    }
    return true;
}

void Record::add(const Record &other)
{
    steps += other.steps;
    contacts += other.contacts;
    wide += other.wide;
    fast += other.fast;
    coarse += other.coarse;
    deepest = std::max(deepest, other.deepest);
    fastest = std::max(fastest, other.fastest);
    shortest = std::min(shortest, other.shortest);
}

std::string Record::text() const
{
    char line[512];
    std::snprintf(line, sizeof line,
                  "restitute: %.0f contacts, %.0f steps of contacts\n"
                  "restitute: largest contact radius over radius %.3g, %.0f contacts beyond the limit of the model\n"
                  "restitute: largest speed over shear wave speed %.3g, %.0f contacts beyond the limit of the model\n"
                  "restitute: shortest time step that a contact asked for %.3g, %.0f contacts had a longer one\n",
                  contacts, steps, std::sqrt(deepest), wide, fastest, fast, contacts > 0 ? shortest : 0, coarse);
    return line;
}

ContactModel::ContactModel(const std::vector<std::string> &words, const Units &units) : words(words)
{
    restitute_contact_motion_init(&motion);
    try {
        read(units);
    } catch (...) {
        restitute_material_destroy(material);
        throw;
    }
    state_size = restitute_contact_law_state_size(law);
}

ContactModel::~ContactModel()
{
    restitute_contact_law_destroy(law);
    restitute_material_destroy(material);
}

static double number(const std::string &word)
{
    double value;
    if (restitute_number_read(word.c_str(), &value) != RESTITUTE_OK)
        throw std::invalid_argument("'" + word + "': must be a number");
    return value;
}

/* A material in units of the host. */
void ContactModel::open(const std::string &file, const Units &units, restitute_material **opened)
{
    restitute_material *si;
    restitute_material_info info;
    restitute_material_info_init(&info);
    if (restitute_material_read_info(file.c_str(), &si, &info, &error) < 0) throw std::invalid_argument(error.message);
    if (info.density > 0) file_density = std::max(file_density, info.density / units.density);
    const size_t n = restitute_material_terms(si);
    std::vector<double> tau(n + 1), g(n + 1);
    double g_inf, eta;
    restitute_material_series(si, &g_inf, &eta, tau.data(), g.data());
    for (double &modulus : g)
        modulus /= units.stress;
    const int status = restitute_material_prony(g_inf / units.stress, eta / units.stress, n, tau.data(), g.data(),
                                                restitute_material_poisson_ratio(si), opened, &error);
    restitute_material_destroy(si);
    if (status < 0) throw std::invalid_argument(error.message);
}

void ContactModel::read(const Units &units)
{
    restitute_contact_law_options options;
    restitute_contact_law_options_init(&options);
    std::string partner;
    const size_t n = words.size();
    size_t i = 1;
    const auto next = [&]() { return i + 1 < n ? words[++i] : throw std::invalid_argument("'" + words[i] + "': lacks its value"); };
    if (n == 0) throw std::invalid_argument("the file of a material is missing");
    for (motion.friction = -1; i < n; i++)
        if (words[i] == "friction")
            motion.friction = number(next());
        else if (words[i] == "partner")
            partner = next();
        else if (words[i] == "elements")
            options.elements = (int)number(next());
        else if (words[i] == "terms")
            options.terms = (int)number(next());
        else if (words[i] == "window")
            options.shortest = number(next()), options.longest = number(next());
        else if (words[i] == "limits")
            radius_limit = number(next()), speed_limit = number(next());
        else
            throw std::invalid_argument("'" + words[i] + "': unknown word");
    if (!(motion.friction >= 0 && motion.friction <= 1e6))
        throw std::invalid_argument("'friction MU' with MU in [0, 1e6] is required");
    options.frictionless = motion.friction == 0;
    open(words[0], units, &material);
    if (partner != "") options.deformable = RESTITUTE_ONE_BODY_DEFORMS;
    if (partner != "" && partner != "rigid") {
        restitute_material *first = material, *second = nullptr, *pair = nullptr;
        open(partner, units, &second);
        const int status = restitute_material_pair(first, second, &pair, &error);
        restitute_material_destroy(second);
        if (status < 0) throw std::invalid_argument(error.message);
        material = pair;
        restitute_material_destroy(first);
    }
    if (restitute_contact_law_create(material, &options, &law, &error) < 0) throw std::invalid_argument(error.message);
}

uint64_t ContactModel::hash() const
{
    return restitute_contact_law_hash(law);
}

void ContactModel::set_step(double step)
{
    if (restitute_contact_rates_set(law, step, &rates, &error) < 0) throw std::invalid_argument(error.message);
}

/* v/c_s as for one impact of the library: with the modulus at the time that the overlap takes. */
void ContactModel::note_first_touch(const Contact &contact, double density)
{
    const double speed = dot(contact.velocity, contact.normal);
    double limit;
    record.contacts++;
    if (restitute_contact_time_step_limit(law, 1 / contact.inverse_mass, contact.radius, speed, &limit, nullptr) < 0)
        return; /* no speed of approach: bodies were put into each other */
    const double time = limit * 50 / 2.94;
    const double wave_speed = std::sqrt(restitute_material_modulus(material, time) / std::max(density, file_density));
    record.fastest = std::max(record.fastest, speed / wave_speed);
    record.fast += speed > speed_limit * wave_speed;
    record.shortest = std::min(record.shortest, limit);
    record.coarse += rates.step > limit;
}

void ContactModel::note_radius(const Contact &contact, double *is_wide)
{
    const double depth = contact.overlap / contact.radius;
    record.deepest = std::max(record.deepest, depth);
    if (*is_wide == 0 && depth > radius_limit * radius_limit) {
        *is_wide = 1;
        record.wide++;
    }
}

static void to_force(const restitute_contact_force &f, const double *normal, double force[3])
{
    for (int i = 0; i < 3; i++)
        force[i] = f.tangential[i] - f.normal * normal[i];
}

const char *ContactModel::advance(const Contact &contact, double density, bool on_record, double *history,
                                  double force[3])
{
    const double tangential = 3.5; /* 1 + R^2/J m of solid spheres */
    const bool is_new = history[0] == 0;
    restitute_contact_force found;
    motion.overlap = contact.overlap;
    motion.normal_velocity = dot(contact.velocity, contact.normal);
    for (int i = 0; i < 3; i++) {
        motion.normal[i] = contact.normal[i];
        motion.displacement[i] = rates.step * contact.velocity[i];
    }
    motion.half_step_over_mass = 0.5 * rates.step * contact.inverse_mass;
    motion.half_step_over_tangential_mass = tangential * motion.half_step_over_mass;
    motion.radius = contact.radius;
    if (restitute_contact_step(law, &rates, &motion, history, &found, &error) < 0) return error.message;
    to_force(found, contact.normal, force);
    if (!on_record) return nullptr;
    record.steps++;
    if (is_new) note_first_touch(contact, density);
    note_radius(contact, &history[state_size]);
    return nullptr;
}

const char *ContactModel::repeat(const Contact &contact, const double *history, double force[3])
{
    restitute_contact_force found;
    if (restitute_contact_peek(law, contact.normal, history, &found, &error) < 0) return error.message;
    to_force(found, contact.normal, force);
    return nullptr;
}

} // namespace restitute_dem
