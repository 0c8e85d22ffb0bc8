/* A contact law with what a DEM code needs: keywords of an input script, the motion of two spheres
 * in contact, and a record of the limits. Does not depend on a DEM code.
 * SPDX-License-Identifier: GPL-2.0-or-later */
#ifndef RESTITUTE_CONTACT_MODEL_H
#define RESTITUTE_CONTACT_MODEL_H

#include "resistance.h"

#include <restitute/contact.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace restitute_dem
{

/* A sphere, or a wall: radius 0 stands for infinite. Of a wall the position is the nearest
 * point. */
struct Body {
    const double *position, *velocity, *spin;
    double radius, inverse_mass; /* 0: nothing moves it */
};

/* Contacts of a law that wait for their forces: they are computed side by side. The normal of a
 * motion points from body 1 into body 2. The arms go from the centres to the contact point,
 * half-way through the overlap. */
struct Batch {
    static constexpr int SIZE = 64;
    int n = 0;
    restitute_contact_motion motion[SIZE];
    bool resists = false;
    double spin[SIZE][3]; /* of body 1 relative to body 2, if the law has resistance */
    double arm1[SIZE], arm2[SIZE];
    double *history[SIZE]; /* of a contact: its label, then its state. All zeros: a new one */
    double label[SIZE];    /* of a new contact: a positive number that identifies it */
    double density[SIZE];  /* of a new contact: of the denser sphere */
    bool on_record[SIZE];
    int first[SIZE], second[SIZE]; /* the host's own */
    double force[SIZE][3];         /* on body 1 */
};

/* Sets the k-th motion of a batch and its arms and returns true. Returns false if the bodies are
 * apart, or if neither can move. Of coincident centres the normal is 0, which a step refuses. */
inline bool touching(const Body &first, const Body &second, Batch &batch, int k)
{
    restitute_contact_motion &m = batch.motion[k];
    const double *a = first.position, *b = second.position, *v = first.velocity, *w = second.velocity;
    const double *p = first.spin, *q = second.spin;
    const double x = b[0] - a[0], y = b[1] - a[1], z = b[2] - a[2], square = x * x + y * y + z * z;
    const double sum = first.radius + second.radius, inverse_mass = first.inverse_mass + second.inverse_mass;
    if (!(square < sum * sum) || inverse_mass == 0) return false;
    const double distance = std::sqrt(square), inverse = distance > 0 ? 1 / distance : 0;
    const double n0 = x * inverse, n1 = y * inverse, n2 = z * inverse;
    m.overlap = sum - distance;
    /* The arms add up to the distance: angular momentum is conserved. */
    const double arm1 = first.radius - 0.5 * m.overlap;
    const double arm2 = second.radius > 0 ? second.radius - 0.5 * m.overlap : 0;
    const double t0 = arm1 * p[0] + arm2 * q[0], t1 = arm1 * p[1] + arm2 * q[1], t2 = arm1 * p[2] + arm2 * q[2];
    m.normal[0] = n0, m.normal[1] = n1, m.normal[2] = n2;
    m.velocity[0] = v[0] - w[0] + t1 * n2 - t2 * n1;
    m.velocity[1] = v[1] - w[1] + t2 * n0 - t0 * n2;
    m.velocity[2] = v[2] - w[2] + t0 * n1 - t1 * n0;
    m.spin = 0.5 * ((p[0] + q[0]) * n0 + (p[1] + q[1]) * n1 + (p[2] + q[2]) * n2);
    m.inverse_mass = inverse_mass;
    m.inverse_tangential_mass = 3.5 * inverse_mass; /* of solid spheres: 1 + m R^2/J */
    m.radius = second.radius > 0 ? first.radius * second.radius / sum : first.radius;
    for (int i = 0; i < 3 && batch.resists; i++)
        batch.spin[k][i] = p[i] - q[i];
    batch.arm1[k] = arm1;
    batch.arm2[k] = arm2;
    return true;
}

/* The record of a run. Four ratios have limits: contact radius over radius and speed over shear
 * wave speed, which are limits of the model; time step over that of the law; and the first overlap
 * over the approach in two steps. If the last one exceeds 1, a contact begins with a deep overlap,
 * and lacks its memory. The last three are those of first touches. */
enum Ratio { RADIUS, SPEED, STEP, DEPTH, RATIOS };

struct Record {
    double steps = 0, contacts = 0; /* calls of the law, first touches */
    double beyond[RATIOS] = {};     /* contacts beyond a limit */
    double largest[RATIOS] = {};
    void add(const Record &other);
    std::string text(const double limits[RATIOS]) const;
    std::string warning(Ratio which, long long step) const; /* STEP or DEPTH; "": nothing to warn of */
};

/* Units of the host in SI: of stress in Pa, of density in kg/m^3. */
struct Units {
    double stress = 1, density = 1;
};

class ContactModel
{
  public:
    /* FILE friction MU [partner rigid|FILE] [elements N] [terms N] [window SHORTEST LONGEST]
     * [rolling sds K GAMMA MU] [twisting sds K GAMMA MU|marshall] [details yes|no] [speed V]
     * [limits A V] Throws std::invalid_argument. */
    ContactModel(const std::vector<std::string> &words, const Units &units);
    ~ContactModel();
    ContactModel(const ContactModel &) = delete;
    ContactModel &operator=(const ContactModel &) = delete;

    const std::vector<std::string> words;
    Record record;
    double limits[RATIOS] = {0.1, 0.1, 1, 1};
    double drift = 0; /* largest motion of bodies in a step that is not in their velocities: see DEPTH */
    double speed = 0; /* for which the user wants the limit of the time step; 0: for none */
    bool has_details = false;

    std::string about() const; /* a line on the law, and a warning about its accuracy */
    uint64_t hash() const;     /* of the law, and of what its history holds */
    int history_size() const;  /* doubles of a contact: label, state, resistance. All zeros: a new one */

    /* Largest time step for impacts at a speed; 0: a value is out of its range. Effective mass and
     * radius. */
    double step_limit(double mass, double radius, double speed) const;

    /* An error text, or NULL. */
    const char *set_step(double step);

    /* A batch for contacts of this model. */
    std::unique_ptr<Batch> make_batch() const;

    /* Forces after a step, or those of the last step again. Returns the number of the first
     * contact that was refused, with a text, or -1. The label of a history becomes negative when
     * the contact counts as beyond RADIUS. */
    int advance(Batch &batch, const char **problem);
    int repeat(Batch &batch, const char **problem);

    /* The force of the last step again; false: the state is refused. */
    bool peek(const double normal[3], const double *history, restitute_contact_force &force);

    bool has_resistance() const
    {
        return resistance.history_size() > 0;
    }
    /* The couple of the last step on body 1 by rolling and twisting resistance; on body 2 acts the
     * opposite. NULL: the law has none. */
    const double *couple(const double *history) const;

    /* Radii and energies; zeros without `details yes`. */
    restitute_contact_details details(double radius, const double *history);

    /* Turns the memory of a contact whose normal has jumped, as at an edge of a mesh. An error
     * text, or NULL. */
    const char *turn(const double from[3], const double to[3], double *history);

  private:
    void read(const Units &units, restitute_contact_law_options &options, std::string &partner);
    void open(const std::string &file, const Units &units, restitute_material **opened);
    void join(const std::string &partner, const Units &units);
    void measure_stiffness(int bodies);
    void note(Batch &batch, const bool *is_new);
    void note_first_touch(const restitute_contact_motion &motion, double density);
    void resist(Batch &batch, int k, double normal_force);
    const char *refusal(const restitute_contact_motion &motion);
    void note(Ratio which, double ratio);

    restitute_material *material = nullptr;
    restitute_contact_law *law = nullptr;
    restitute_contact_rates rates;
    restitute_contact_motion motion;
    Resistance resistance;
    restitute_error error = {};
    std::string remark;      /* of the library on the law */
    double file_density = 0; /* of the denser material; 0: not given */
};

} // namespace restitute_dem

#endif
