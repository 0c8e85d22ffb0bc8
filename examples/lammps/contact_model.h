/* A contact law and what a DEM code needs around it: words of an input script, the motion of two
 * spheres that touch, and a record of what was met. Knows no DEM code.
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

/* Sets the contact and returns true; or false: apart, or bodies that nothing moves. */
bool touching(const Body &first, const Body &second, Contact &contact);

/* What a run met. Four ratios have limits: contact radius over radius and speed over shear wave
 * speed, limits of the model, time step over that of the law, and the first overlap over what two
 * steps of approach explain: beyond 1 a contact begins deep, without a memory that it should have.
 * The last three are those of first touches. */
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
    double drift = 0; /* how far the host moves bodies in a step besides their velocities, at most: see DEPTH */

    std::string about() const; /* a line on the law, and one on what is poor about it */
    uint64_t hash() const;     /* of the law */
    int history_size() const;  /* doubles of a contact: its label, then its state. All zeros: a new one */

    /* What follows returns what is wrong, or NULL. */
    const char *set_step(double step);

    /* The force on body 1 after a step. `density`: of the denser sphere. `label`: a positive number
     * by which the host knows a new contact again. In the history it becomes negative when the
     * contact counts as beyond RADIUS. */
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
    restitute_contact_rates rates = {};
    restitute_contact_motion motion;
    restitute_error error = {};
    std::string remark;      /* of the library on the law */
    double file_density = 0; /* of the denser material; 0: not given */
};

} // namespace restitute_dem

#endif
