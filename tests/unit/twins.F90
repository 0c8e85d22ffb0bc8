! SPDX-License-Identifier: BSD-3-Clause
!> Where the members of the derived types begin that C fills or reads, for test_twins.c.
module twins
  use, intrinsic :: iso_c_binding, only: c_int64_t, c_intptr_t, c_loc, c_ptr, c_size_t, c_sizeof
  use rst_series, only: rst_chain_type => chain_type
  use rst_ledger, only: rst_ledger_type => ledger_type
  use rst_euler, only: euler_scene_type => scene_type, euler_state_type => state_type
  use rst_panel, only: sync_panel_type => panel_type
  use rst_normal_motion, only: sync_normal_control_type => normal_control_type
  use rst_sync_interface, only: sync_normal_type => normal_arrays_type, sync_store_type => store_arrays_type
  use rst_store, only: sync_contact_type => contact_type, sync_record_type => record_type, &
                  sync_piece_type => piece_type
  use rst_sync_walk, only: walk_type, walk_level_type, &
                  walk_shear_type, walk_term_type
#ifdef RESTITUTE_WITH_CVODE
  use rst_cvode_types, only: cvode_scene_type => scene_type, cvode_contact_type => contact_type, &
                  cvode_sums_type => shear_sums_type, element_energy_type => energy_type
#endif
  implicit none (type, external)
  private

contains

  !> Offsets of the members of the type i of test_twins.c, then its size; n: how many numbers. 0: no
  !> such type.
  subroutine fortran_offsets(i, n, offset) bind(c)
    integer(c_int64_t), value :: i
    integer(c_int64_t), intent(out) :: n, offset(40)
    type(rst_chain_type), target :: chain
    type(rst_ledger_type), target :: ledger
    type(euler_scene_type), target :: euler_scene
    type(euler_state_type), target :: euler_state
    type(sync_panel_type), target :: sync_panel
    type(sync_normal_control_type), target :: sync_normal_control
    type(sync_normal_type), target :: sync_normal
    type(sync_contact_type), target :: sync_contact
    type(sync_record_type), target :: sync_record
    type(sync_piece_type), target :: sync_piece
    type(sync_store_type), target :: sync_store
    type(walk_type), target :: walk
    type(walk_level_type), target :: walk_level
    type(walk_shear_type), target :: walk_shear
    type(walk_term_type), target :: walk_term
#ifdef RESTITUTE_WITH_CVODE
    type(cvode_scene_type), target :: cvode_scene
    type(cvode_contact_type), target :: cvode_contact
    type(cvode_sums_type), target :: cvode_sums
    type(element_energy_type), target :: element_energy
#endif
    n = 0
    select case (i)
    case (0)
      call put(c_sizeof(chain), [c_loc(chain%m_inf), c_loc(chain%eta), c_loc(chain%n)])
    case (1)
      call put(c_sizeof(ledger), [c_loc(ledger%viscous_z), c_loc(ledger%left_z), c_loc(ledger%friction_x), &
                c_loc(ledger%viscous_x), c_loc(ledger%left_x)])
    case (2)
      call put(c_sizeof(euler_scene), [c_loc(euler_scene%chi), c_loc(euler_scene%shear_speed), c_loc(euler_scene%g_inf), &
                c_loc(euler_scene%eta), c_loc(euler_scene%step), c_loc(euler_scene%spacing), &
                c_loc(euler_scene%rest_speed), c_loc(euler_scene%n_terms), c_loc(euler_scene%capacity), &
                c_loc(euler_scene%can_sink), c_loc(euler_scene%keep_ledger), c_loc(euler_scene%mode)])
    case (3)
      call put(c_sizeof(euler_state), [c_loc(euler_state%time), c_loc(euler_state%depth), &
                c_loc(euler_state%velocity), c_loc(euler_state%shift), c_loc(euler_state%shear_velocity), &
                c_loc(euler_state%force), c_loc(euler_state%shear_force), c_loc(euler_state%true_edge_force), &
                c_loc(euler_state%true_edge_shear), c_loc(euler_state%centre_force), &
                c_loc(euler_state%leave_time), c_loc(euler_state%max_depth), c_loc(euler_state%max_force), &
                c_loc(euler_state%max_time), c_loc(euler_state%n_contact), c_loc(euler_state%max_contact), &
                c_loc(euler_state%phase), c_loc(euler_state%mode), c_loc(euler_state%n_steps), &
                c_loc(euler_state%n_updates), c_loc(euler_state%n_stalled), c_loc(euler_state%ledger)])
    case (4)
      call put(c_sizeof(sync_panel), [c_loc(sync_panel%from), c_loc(sync_panel%to), c_loc(sync_panel%radius), &
                c_loc(sync_panel%time), c_loc(sync_panel%depth), c_loc(sync_panel%velocity), &
                c_loc(sync_panel%force), c_loc(sync_panel%pace)])
    case (5)
      call put(c_sizeof(sync_normal_control), [c_loc(sync_normal_control%roughness), &
                c_loc(sync_normal_control%stop_speed), c_loc(sync_normal_control%halvings), &
                c_loc(sync_normal_control%capacity), c_loc(sync_normal_control%n_coarse), &
                c_loc(sync_normal_control%n_coarse_compression), c_loc(sync_normal_control%coarse)])
    case (6)
      call put(c_sizeof(sync_normal), [c_loc(sync_normal%eta), c_loc(sync_normal%scale), &
                c_loc(sync_normal%closeness), c_loc(sync_normal%residual_speed), c_loc(sync_normal%n_arms), &
                c_loc(sync_normal%n_compression), c_loc(sync_normal%n_panels), c_loc(sync_normal%g), &
                c_loc(sync_normal%rate), c_loc(sync_normal%panel), c_loc(sync_normal%memory), &
                c_loc(sync_normal%loading), c_loc(sync_normal%kernel), c_loc(sync_normal%entry)])
    case (7)
      call put(c_sizeof(sync_contact), [c_loc(sync_contact%chi), c_loc(sync_contact%psi), &
                c_loc(sync_contact%roughness), c_loc(sync_contact%noise), c_loc(sync_contact%closeness), &
                c_loc(sync_contact%stress), c_loc(sync_contact%mode)])
    case (8)
      call put(c_sizeof(sync_record), [c_loc(sync_record%from), c_loc(sync_record%to), &
                c_loc(sync_record%touch)])
    case (9)
      call put(c_sizeof(sync_piece), [c_loc(sync_piece%panel), c_loc(sync_piece%rooted), c_loc(sync_piece%from), &
                c_loc(sync_piece%to), c_loc(sync_piece%shear_velocity), c_loc(sync_piece%shear_force), &
                c_loc(sync_piece%stick_radius)])
    case (10)
      call put(c_sizeof(sync_store), [c_loc(sync_store%capacity), c_loc(sync_store%n_records), &
                c_loc(sync_store%n_pieces), c_loc(sync_store%n_trials), c_loc(sync_store%record), c_loc(sync_store%piece), &
                c_loc(sync_store%corrective), c_loc(sync_store%room)])
    case (11)
      call put(c_sizeof(walk), [c_loc(walk%n), c_loc(walk%n_terms), c_loc(walk%capacity), c_loc(walk%start), &
                c_loc(walk%end), c_loc(walk%mode), c_loc(walk%prescribed), c_loc(walk%divides), c_loc(walk%chi), &
                c_loc(walk%psi), c_loc(walk%g_inf), c_loc(walk%eta)])
    case (12)
      call put(c_sizeof(walk_level), [c_loc(walk_level%step), c_loc(walk_level%radius), c_loc(walk_level%depth), &
                c_loc(walk_level%velocity), c_loc(walk_level%force)])
    case (13)
      call put(c_sizeof(walk_shear), [c_loc(walk_shear%velocity), c_loc(walk_shear%force)])
    case (14)
      call put(c_sizeof(walk_term), [c_loc(walk_term%g), c_loc(walk_term%decay), c_loc(walk_term%from_start), &
                c_loc(walk_term%from_end), c_loc(walk_term%normal)])
#ifdef RESTITUTE_WITH_CVODE
    case (15)
      call put(c_sizeof(cvode_scene), [c_loc(cvode_scene%chi), c_loc(cvode_scene%g_inf), c_loc(cvode_scene%eta), &
                c_loc(cvode_scene%reference), c_loc(cvode_scene%step_start), c_loc(cvode_scene%n_terms), &
                c_loc(cvode_scene%n_modes), c_loc(cvode_scene%n_states), c_loc(cvode_scene%n_knots), &
                c_loc(cvode_scene%n_nodes), c_loc(cvode_scene%n_entered), c_loc(cvode_scene%restitution), &
                c_loc(cvode_scene%mode)])
    case (16)
      call put(c_sizeof(cvode_contact), [c_loc(cvode_contact%square), c_loc(cvode_contact%radius), &
                c_loc(cvode_contact%force)])
    case (17)
      call put(c_sizeof(cvode_sums), [c_loc(cvode_sums%force), c_loc(cvode_sums%stick), &
                c_loc(cvode_sums%backward), c_loc(cvode_sums%n_contact)])
    case (18)
      call put(c_sizeof(element_energy), [c_loc(element_energy%f), c_loc(element_energy%q), &
                c_loc(element_energy%viscous_z), c_loc(element_energy%viscous_x), c_loc(element_energy%held_z), &
                c_loc(element_energy%held_x), c_loc(element_energy%motion)])
#endif
    end select

  contains

    subroutine put(bytes, place)
      integer(c_size_t), intent(in) :: bytes
      type(c_ptr), intent(in) :: place(:)
      integer(c_int64_t) :: k
      n = size(place, kind=c_int64_t)
      do k = 1, n
        offset(k) = transfer(place(k), 0_c_intptr_t) - transfer(place(1), 0_c_intptr_t)
      end do
      n = n + 1
      offset(n) = int(bytes, c_int64_t)
    end subroutine put
  end subroutine fortran_offsets
end module twins
