/* Springs and dashpots over one time step, exact for a velocity that is linear in it
 * (docs/contact.md), and how deep and how long a contact will be.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "contact/law.h"

struct rst_arm rst_arm_of(double step, double tau)
{
    static const double series_below = 0.01; /* there z^4/120 is rounding */
    const double z = step / tau, decay = exp(-z), lost = -expm1(-z);
    if (z < series_below)
        return (struct rst_arm){decay, 1 - z * (1 / 2.0 - z * (1 / 6.0 - z / 24)),
                                step * z * (1 / 6.0 - z * (1 / 12.0 - z / 40))};
    return (struct rst_arm){decay, lost / z, tau * (1 + decay - 2 * lost / z)};
}

/* int g w^2/tau dt over the step, w decaying and displaced evenly: factors of w^2, w du, du^2. */
static void set_spent(double step, double tau, double g, double spent[3])
{
    const double z = step / tau, lost = -expm1(-z), twice = -expm1(-2 * z) / 2;
    spent[0] = g * twice;
    spent[1] = g * lost * lost / z;
    spent[2] = g * (z < 0.01 ? z * (1 / 3.0 - z * (1 / 4.0 - z * 7 / 60)) : (z - 2 * lost + twice) / (z * z));
}

void rst_law_rates(const struct rst_law *law, double step, struct rst_rates *rates)
{
    double stiffness = law->g_inf + law->eta / step;
    *rates = (struct rst_rates){.viscosity = law->eta};
    for (int k = 0; k < law->at.terms; k++) {
        struct rst_arm arm = rst_arm_of(step, law->tau[k]);
        if (law->tau[k] > step) arm.bend = 0; /* slow arms are springs: their forces do not follow the velocity */
        rates->decay[k] = arm.decay;
        rates->gain[k] = arm.gain;
        rates->bend[k] = arm.bend;
        set_spent(step, law->tau[k], law->g[k], rates->spent[k]);
        stiffness += law->g[k] * arm.gain;
        rates->viscosity += law->g[k] * arm.bend;
    }
    rates->compliance = 1 / stiffness;
}

/* The mean of a modulus over a time, with a term's z = time/tau. */
static double mean_of_term(double z)
{
    return z > 1e-6 ? (1 - exp(-z)) / z : 1;
}

/* That of the elastic impact (24) with the mean modulus over 0.88 d/v, a fixed point. The contact
 * radius is 0 to 6 % less (with a parallel dashpot +-3 %, its part is fitted). */
double rst_law_largest_overlap(const struct rst_law *law, double mass, double radius, double speed)
{
    static const double share_of_time = 0.88, share_of_dashpot = 0.735;
    enum { iterations = 24 }; /* each takes 30 to 50 % off the error of log d, which starts below 20 */
    const double energy = pow(15 * (mass * speed * speed) / (8 * law->normal * sqrt(radius)), 0.4);
    double d = radius;
    for (int i = 0; i < iterations; i++) {
        const double time = share_of_time * d / speed;
        double g = law->g_inf + law->eta * (share_of_time / share_of_dashpot) / time;
        for (int k = 0; k < law->at.terms; k++)
            g += law->g[k] * mean_of_term(time / law->tau[k]);
        d = sqrt(d * (energy / pow(g, 0.4))); /* not (./g)^0.4, which may underflow under a dashpot */
    }
    return d;
}
