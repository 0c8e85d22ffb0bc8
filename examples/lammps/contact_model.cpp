/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "contact_model.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

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
    if (!(square < sum * sum) || c.inverse_mass == 0) return false;
    const double distance = std::sqrt(square), inverse = distance > 0 ? 1 / distance : 0;
    const double n0 = x * inverse, n1 = y * inverse, n2 = z * inverse;
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
    for (int i = 0; i < 3; i++)
        c.spin[i] = first.spin[i] - second.spin[i];
    c.mean_spin = 0.5 * (dot(first.spin, c.normal) + dot(second.spin, c.normal));
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

/* To three digits, so that a ratio beyond 1 does not read as 1. */
static double rounded_up(double ratio)
{
    const double unit = std::pow(10, std::floor(std::log10(ratio)) - 2);
    return std::ceil(ratio / unit) * unit;
}

std::string Record::warning(Ratio which, long long step) const
{
    char line[300] = "";
    if (which == STEP && beyond[STEP] > 0)
        std::snprintf(line, sizeof line,
                      "restitute: a contact began at step %lld that needs a time step shorter by a factor of %.3g",
                      step, rounded_up(largest[STEP]));
    if (which == DEPTH && beyond[DEPTH] > 0)
        std::snprintf(line, sizeof line,
                      "restitute: a contact began at step %lld with %.3g times the overlap that two steps explain: "
                      "spheres were created with an overlap, or their contact was lost or found late; see 'Spheres "
                      "that overlap' in contacts.md of the adapter",
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
    const double mass = 1 / contact.inverse_mass;
    double scale;
    record.contacts++;
    note(DEPTH, contact.overlap / (2 * (rates.step * std::max(speed, 0.0) + drift) + 1e-5 * contact.radius));
    if (restitute_contact_time_scale(law, mass, contact.radius, speed, &scale, nullptr) < 0)
        return; /* no speed of approach: bodies were put into each other */
    const double modulus = restitute_material_modulus(material, scale);
    note(SPEED, speed / std::sqrt(modulus / std::max(density, file_density)));
    note(STEP, rates.step / step_limit(mass, contact.radius, speed));
}

/* ---- time steps */

const char *ContactModel::set_step(double step)
{
    return restitute_contact_rates_set(law, step, &rates, &error) < 0 ? error.message : nullptr;
}

double ContactModel::step_limit(double mass, double radius, double speed) const
{
    double limit = 0;
    restitute_contact_time_step_limit(law, mass, radius, speed, &limit, nullptr);
    return limit;
}

static void to_force(const restitute_contact_force &f, const double *normal, double force[3])
{
    for (int i = 0; i < 3; i++)
        force[i] = f.tangential[i] - f.normal * normal[i];
}

void ContactModel::describe(const Contact &contact)
{
    const double solid_sphere = 3.5; /* 1 + m R^2/J */
    motion.overlap = contact.overlap;
    for (int i = 0; i < 3; i++) {
        motion.normal[i] = contact.normal[i];
        motion.velocity[i] = contact.velocity[i];
    }
    motion.spin = contact.mean_spin;
    motion.inverse_mass = contact.inverse_mass;
    motion.inverse_tangential_mass = solid_sphere * contact.inverse_mass;
    motion.radius = contact.radius;
}

const char *ContactModel::advance(const Contact &contact, double density, bool on_record, double *history,
                                  double force[3], double label)
{
    restitute_contact_force found;
    describe(contact);
    if (restitute_contact_step(law, &rates, &motion, history + 1, &found, &error) < 0) return refusal(contact);
    to_force(found, contact.normal, force);
    settle(contact, density, on_record, found, history, label);
    return nullptr;
}

/* What follows a step of the law. */
void ContactModel::settle(const Contact &c, double density, bool on_record, const restitute_contact_force &force,
                          double *history, double label)
{
    const bool is_new = history[0] == 0;
    if (is_new) history[0] = label;
    if (has_resistance()) {
        Turning turning = {{}, {}, c.radius, std::sqrt(c.overlap * c.radius), force.normal, rates.step};
        std::copy_n(c.normal, 3, turning.normal);
        std::copy_n(c.spin, 3, turning.spin);
        resistance.advance(turning, history + history_size() - resistance.history_size());
    }
    if (!on_record) return;
    record.steps++;
    if (is_new) note_first_touch(c, dot(c.velocity, c.normal), density);
    const double largest = record.largest[RADIUS], limit = limits[RADIUS], depth = c.overlap; /* = a^2/R */
    if (depth > largest * largest * c.radius) record.largest[RADIUS] = std::sqrt(depth / c.radius);
    if (depth > limit * limit * c.radius && history[0] > 0) {
        history[0] = -history[0];
        record.beyond[RADIUS]++;
    }
}

/* The library names its own arguments. This says what to do in a DEM code. */
const char *ContactModel::refusal(const Contact &c)
{
    char *text = error.message;
    const size_t size = sizeof error.message;
    const std::string said = text;
    const auto is_about = [&said](const char *words) { return said.find(words) != std::string::npos; };
    const double *n = c.normal, *v = c.velocity, speed = dot(v, n);
    if (dot(n, n) == 0)
        std::snprintf(text, size, "the centers coincide, or a center lies on a wall: there is no normal");
    else if (c.overlap > c.radius)
        std::snprintf(text, size,
                      "an overlap of %.6g: must be at most the effective radius, %.6g. Take a shorter time step; of "
                      "spheres that overlap at the start see 'Spheres that overlap' in contacts.md of the adapter",
                      c.overlap, c.radius);
    else if (is_about("another law"))
        std::snprintf(text, size,
                      "the contact began under another law: types of spheres or words of the law have changed since. "
                      "Change them while the bodies are apart, or delete all contacts first (LAMMPS: pair_style none)");
    else if (is_about("has turned too far"))
        std::snprintf(text, size,
                      "the normal has turned by more than 60 degrees in a step: were spheres in contact displaced?");
    else if (is_about("less than ten steps"))
        std::snprintf(text, size,
                      "a contact that begins with speed %.6g would last less than ten steps of %.6g: take a time step "
                      "of at most %.3g",
                      speed, rates.step, step_limit(1 / c.inverse_mass, c.radius, speed));
    else if (is_about("motion.velocity"))
        std::snprintf(text, size,
                      "relative velocity (%.6g, %.6g, %.6g): must be at most the effective radius %.6g in a step of "
                      "%.6g either way",
                      v[0], v[1], v[2], c.radius, rates.step);
    return text;
}

const char *ContactModel::repeat(const Contact &contact, const double *history, restitute_contact_force &force)
{
    const bool failed = restitute_contact_peek(law, contact.normal, history + 1, &force, &error) < 0;
    return failed ? refusal(contact) : nullptr;
}

const char *ContactModel::repeat(const Contact &contact, const double *history, double force[3])
{
    restitute_contact_force found;
    if (const char *problem = repeat(contact, history, found)) return problem;
    to_force(found, contact.normal, force);
    return nullptr;
}

const double *ContactModel::couple(const double *history) const
{
    return has_resistance() ? history + history_size() - resistance.history_size() : nullptr;
}

restitute_contact_details ContactModel::details(double radius, const double *history)
{
    restitute_contact_details found;
    restitute_contact_details_init(&found);
    if (has_details) restitute_contact_details_get(law, radius, history + 1, &found, &error);
    return found;
}

const char *ContactModel::turn(const double from[3], const double to[3], double *history)
{
    return restitute_contact_turn(law, from, to, history + 1, &error) < 0 ? error.message : nullptr;
}

} // namespace restitute_dem
