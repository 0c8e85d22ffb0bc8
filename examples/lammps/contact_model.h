/* A contact law with what a DEM code needs: keywords of an input script, the motion of two spheres
 * in contact, and a record of the limits. Does not depend on a DEM code.
 * SPDX-License-Identifier: GPL-2.0-or-later */
#ifndef RESTITUTE_CONTACT_MODEL_H
#define RESTITUTE_CONTACT_MODEL_H

#include "resistance.h"

#include <restitute/contact.h>

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

/* Two bodies that touch. The normal points from body 1 into body 2. */
struct Contact {
    double overlap, normal[3], velocity[3]; /* velocity: of the surface of body 1 past that of body 2 */
    double arm1, arm2;                      /* from the centres to the contact point, half-way through the overlap */
    double spin[3], mean_spin;              /* of body 1 relative to body 2; mean of both about the normal */
    double radius, inverse_mass;            /* effective */
};

/* Sets the contact and returns true. Returns false if the bodies are apart, or if neither can
 * move. Of coincident centres the normal is 0, which a step refuses. */
bool touching(const Body &first, const Body &second, Contact &contact);

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

    /* The following functions return an error text, or NULL. */
    const char *set_step(double step);

    /* The force on body 1 after a step. `density`: of the denser sphere. `label`: a positive number
     * that identifies a new contact. In the history it becomes negative when the contact counts as
     * beyond RADIUS. */
    const char *advance(const Contact &contact, double density, bool on_record, double *history, double force[3],
                        double label = 1);

    /* The force of the last step again. */
    const char *repeat(const Contact &contact, const double *history, double force[3]);
    const char *repeat(const Contact &contact, const double *history, restitute_contact_force &force);

    bool has_resistance() const
    {
        return resistance.history_size() > 0;
    }
    /* The couple of the last step on body 1 by rolling and twisting resistance; on body 2 acts the
     * opposite. NULL: the law has none. */
    const double *couple(const double *history) const;

    /* Radii and energies; zeros without `details yes`. */
    restitute_contact_details details(double radius, const double *history);

    /* Turns the memory of a contact whose normal has jumped, as at an edge of a mesh. */
    const char *turn(const double from[3], const double to[3], double *history);

  private:
    void read(const Units &units, restitute_contact_law_options &options, std::string &partner);
    void open(const std::string &file, const Units &units, restitute_material **opened);
    void join(const std::string &partner, const Units &units);
    void measure_stiffness(int bodies);
    void describe(const Contact &contact);
    void settle(const Contact &contact, double density, bool on_record, const restitute_contact_force &force,
                double *history, double label);
    const char *refusal(const Contact &contact);
    void note_first_touch(const Contact &contact, double speed, double density);
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
