/* Plain words about what the data leave open.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_FIT_REMARKS_H
#define RST_FIT_REMARKS_H

#include "search.h"

/* Adds a line to the remarks, as far as there is room, and raises the flag. */
void rst_fit_remark(restitute_fit_result *result, int flag, const char *format, ...);

/* Constants and combinations that may be anything. */
void rst_fit_remark_directions(const struct rst_fit_search *search, const struct rst_fit_certainty *certainty,
                               restitute_fit_result *result);

/* Residuals that have the same sign for many speeds in a row; noise that is known and surpassed. */
int rst_fit_remark_pattern(struct rst_fit_search *search, const struct rst_fit_certainty *certainty,
                           restitute_fit_result *result);

/* Impacts beyond the limits of the contact model. */
int rst_fit_remark_limits(struct rst_fit_search *search, restitute_fit_result *result);

/* The model beside a rival: as good with fewer constants, or worse than one with more. */
void rst_fit_remark_rival(const struct rst_fit_search *search, const struct rst_fit_certainty *certainty,
                          const struct rst_fit_search *rival, restitute_fit_result *result);

#endif
