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
void ContactModel::note_first_touch(const restitute_contact_motion &contact, double density)
{
    const double speed = dot(contact.velocity, contact.normal), mass = 1 / contact.inverse_mass;
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

std::unique_ptr<Batch> ContactModel::make_batch() const
{
    auto batch = std::make_unique<Batch>();
    std::fill_n(batch->motion, Batch::SIZE, motion);
    batch->resists = has_resistance();
    return batch;
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
        const int bad = (int)(std::find_if(status, status + b.n, [](int one) { return one < 0; }) - status);
        *problem = refusal(b.motion[bad]);
        return bad;
    }
    for (int k = 0; k < b.n; k++) {
        to_force(found[k], b.motion[k].normal, b.force[k]);
        if (b.resists) resist(b, k, found[k].normal);
    }
    note(b, is_new);
    return -1;
}

void ContactModel::resist(Batch &b, int k, double normal_force)
{
    const restitute_contact_motion &m = b.motion[k];
    Turning turning = {{}, {}, m.radius, std::sqrt(m.overlap * m.radius), normal_force, rates.step};
    std::copy_n(m.normal, 3, turning.normal);
    std::copy_n(b.spin[k], 3, turning.spin);
    resistance.advance(turning, b.history[k] + history_size() - resistance.history_size());
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

/* The library names its own arguments. This says what to do in a DEM code. */
const char *ContactModel::refusal(const restitute_contact_motion &c)
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
    else if (is_about("motions["))
        std::snprintf(text, size, "%s", said.substr(said.find(": ") + 2).c_str());
    return text;
}

bool ContactModel::peek(const double normal[3], const double *history, restitute_contact_force &force)
{
    return restitute_contact_peek(law, normal, history + 1, &force, &error) >= 0;
}

int ContactModel::repeat(Batch &b, const char **problem)
{
    restitute_contact_force found;
    for (int k = 0; k < b.n; k++) {
        if (!peek(b.motion[k].normal, b.history[k], found)) {
            *problem = refusal(b.motion[k]);
            return k;
        }
        to_force(found, b.motion[k].normal, b.force[k]);
    }
    return -1;
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
