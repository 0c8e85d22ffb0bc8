/* psi_c by bisection.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "sweep_slip.h"

#include <math.h>

#include "paper.h"

/* The standard solid in units of G1 and T: one Maxwell arm of modulus 1/gamma and time gamma theta, or a dashpot. */
static struct paper_problem problem_of(double chi, double delta1, double gamma, double *arm)
{
    const double theta = sqrt(32.0 / 15.0) * delta1;
    arm[0] = 1 / gamma;
    arm[1] = gamma * theta;
    return (struct paper_problem){.chi = chi,
                                  .g_inf = 1,
                                  .eta = gamma > 0 ? 0 : theta,
                                  .n_terms = gamma > 0 && theta > 0,
                                  .g = &arm[0],
                                  .tau = &arm[1]};
}

double sweep_critical_psi(double chi, double delta1, double gamma, const restitute_result *result, int64_t elements)
{
    double arm[2], low = 1, high = 4 * chi; /* psi_c <= 4 chi - 1 */
    struct paper_problem problem = problem_of(chi, delta1, gamma, arm);
    const int64_t steps = 64 * elements;
    const struct paper_settings settings = {.motion = PAPER_EULER,
                                            .elements = elements + elements / 4 + 1,
                                            .spacing = result->max_contact_radius / (double)elements,
                                            .step = result->contact_time / (double)steps,
                                            .max_steps = 20 * steps,
                                            .trial_sign = 1};
    while (high - low > 1e-9) {
        struct paper_result run;
        problem.psi = 0.5 * (low + high);
        if (paper_solve(&problem, &settings, &run) != PAPER_SEPARATED) return NAN;
        if (run.sticking)
            low = problem.psi;
        else
            high = problem.psi;
    }
    return 0.5 * (low + high);
}
