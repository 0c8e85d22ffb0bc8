/* The last member that each public struct had in the first release that had it (0.1 for all of
 * these). What a caller's struct has beyond it depends on the headers that he was compiled with;
 * see base/sized.h.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_FIRST_RELEASE_H
#define RST_FIRST_RELEASE_H

/* restitute.h */
#define RST_LAST_impact material
#define RST_LAST_scene wave_density
#define RST_LAST_numbers dundurs_beta
#define RST_LAST_options dundurs_limit
#define RST_LAST_result method
#define RST_LAST_ledger residual_x
#define RST_LAST_history tangential_velocity
#define RST_LAST_body normal
#define RST_LAST_collision wave_density

/* contact.h */
#define RST_LAST_contact_law_options details
#define RST_LAST_contact_rates values
#define RST_LAST_contact_motion friction
#define RST_LAST_contact_details viscous_power

/* table.h */
#define RST_LAST_table_options interrupted_data
#define RST_LAST_table_contact touch_gap
#define RST_LAST_table_info version
#define RST_LAST_table_data ex

/* cvode.h, bem.h */
#define RST_LAST_cvode_events event
#define RST_LAST_cvode_work stiff
#define RST_LAST_bem_snapshot stick

/* files.h, fit.h */
#define RST_LAST_material_info viscosity
#define RST_LAST_fit_point sigma_contact_time
#define RST_LAST_fit_options interrupted_data
#define RST_LAST_fit_result material
#define RST_LAST_dma_options wlf_c2
#define RST_LAST_dma_result material

#endif
