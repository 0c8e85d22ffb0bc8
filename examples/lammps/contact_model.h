/* A contact law with what a DEM code needs: keywords of an input script, the motion of two spheres
 * in contact, and a record of the limits. Does not depend on a DEM code.
 * SPDX-License-Identifier: GPL-2.0-or-later */
#ifndef RESTITUTE_CONTACT_MODEL_H
#define RESTITUTE_CONTACT_MODEL_H

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
    double radius, inverse_mass;            /* effective */
};

/* Sets the contact and returns true. Returns false if the bodies are apart, or if neither can
 * move. */
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
     * [limits A V] Throws std::invalid_argument. */
    ContactModel(const std::vector<std::string> &words, const Units &units);
    ~ContactModel();
    ContactModel(const ContactModel &) = delete;
    ContactModel &operator=(const ContactModel &) = delete;

    const std::vector<std::string> words;
    Record record;
    double limits[RATIOS] = {0.1, 0.1, 1, 1};
    double drift = 0; /* largest motion of bodies in a step that is not in their velocities: see DEPTH */

    std::string about() const; /* a line on the law, and a warning about its accuracy */
    uint64_t hash() const;     /* of the law */
    int history_size() const;  /* doubles of a contact: its label, then its state. All zeros: a new one */

    /* The following functions return an error text, or NULL. */
    const char *set_step(double step);

    /* The force on body 1 after a step. `density`: of the denser sphere. `label`: a positive number
     * that identifies a new contact. In the history it becomes negative when the contact counts as
     * beyond RADIUS. */
    const char *advance(const Contact &contact, double density, bool on_record, double *history, double force[3],
                        double label = 1);

    /* The force of the last step again. */
    const char *repeat(const Contact &contact, const double *history, double force[3]);

    /* Turns the memory of a contact whose normal has jumped, as at an edge of a mesh. */
    const char *turn(const double from[3], const double to[3], double *history);

  private:
    void read(const Units &units, restitute_contact_law_options &options, std::string &partner);
    void open(const std::string &file, const Units &units, restitute_material **opened);
    void join(const std::string &partner, const Units &units);
    void note_first_touch(const Contact &contact, double speed, double density);
    void note(Ratio which, double ratio);

    restitute_material *material = nullptr;
    restitute_contact_law *law = nullptr;
    restitute_contact_rates rates;
    restitute_contact_motion motion;
    restitute_error error = {};
    std::string remark;      /* of the library on the law */
    double file_density = 0; /* of the denser material; 0: not given */
};

} // namespace restitute_dem

#endif
