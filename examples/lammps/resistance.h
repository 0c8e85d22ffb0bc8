/* Rolling and twisting resistance of a contact whose normal force is known: the models `rolling
 * sds`, `twisting sds` and `twisting marshall` of LAMMPS's pair_style granular. Does not depend on
 * a DEM code.
 *
 * Rolling: S. Luding, Granular Matter 10 (2008) 235, with the rolling velocity of Y. Wang et al.,
 * Particuology 23 (2015) 49, eq. 31. Twisting: J. S. Marshall, J. Comput. Phys. 228 (2009) 1541,
 * eqs. 29 to 34.
 * SPDX-License-Identifier: GPL-2.0-or-later */
#ifndef RESTITUTE_RESISTANCE_H
#define RESTITUTE_RESISTANCE_H

namespace restitute_dem
{

/* A spring and a dashpot, in series with a slider. Of rolling in N/m, N s/m and 1; of twisting in
 * N m, N m s and m; or in like units of the host. */
struct Slider {
    double stiffness = 0, damping = 0, friction = 0;
};

/* How two bodies turn against each other in a step. */
struct Turning {
    double normal[3], spin[3];     /* normal: from body 1 into body 2; spin: of body 1 relative to body 2 */
    double radius, contact_radius; /* radius: effective */
    double normal_force, step;
};

struct Resistance {
    bool rolls = false, twists = false, is_marshall = false;
    Slider rolling, twisting;
    /* For Marshall: of the tangential force, over the contact radius; and the coefficient of
     * friction. */
    Slider tangential;

    /* Numbers of a contact: the couple on body 1 (on body 2 acts the opposite), the rolling
     * displacement, the twist angle. All zeros: a new contact. */
    int history_size() const
    {
        return rolls || twists ? 7 : 0;
    }
    void advance(const Turning &turning, double *history) const;
};

} // namespace restitute_dem

#endif
