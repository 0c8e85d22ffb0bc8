/* SPDX-License-Identifier: BSD-3-Clause
 * Kinetic theory of a homogeneous cooling gas of smooth spheres, in the units of gas.h. */
#ifndef THEORY_H
#define THEORY_H

#include "gas.h"

/* Haff's law, T = T0/(1 + t/t0)^2, of a constant ez: the temperature after `time`. The coefficient
 * is that of the homogeneous cooling state, with the second Sonine coefficient a2 by van Noije and
 * Ernst (1998). */
double theory_haff(double ez, double start, double time);

/* The temperature after `time`, from `start`, in a gas of frictionless spheres of any ez(v), with
 * Maxwell's velocity distribution: dT/dt = -(omega/3) A(T) T, omega = 4 sqrt(T/pi), A = <1 -
 * ez^2>. */
double theory_frictionless(const struct gas_law *law, double start, double time);

#endif
