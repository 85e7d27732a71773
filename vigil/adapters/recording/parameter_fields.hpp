#pragma once

#include <cstdint>
#include <optional>

#include "vigil/swarm/parameters.hpp"

namespace vigil::recording {

// A parameter that is not recorded would be another one when the flight is flown again, so this breaks when there is a
// new one: show it below, add it to Mission.msg, then correct the size.
static_assert(sizeof(void*) != 8 || sizeof(swarm::SwarmParameters) == 608);

/// Shows every value of the controller's parameters to `visit`, in the order of vigil_msgs/msg/Mission: writer and
/// reader go by this one list. visit() takes numbers, flags and optional numbers, visit.count() and visit.index() whole
/// ones, visit.limit() a number that may be infinite, visit.choice() an enumeration of so many values.
template <class Visit, class Parameters>
void visit_parameters(Visit& visit, Parameters& p) {
  visit(p.field.length_x);
  visit(p.field.length_y);
  visit.count(p.drones);
  visit(p.dt_s);
  visit.index(p.basis_max_index);
  visit(p.basis_smoothness);
  visit.choice(p.accounting, 3);
  visit(p.memory_s);
  visit.choice(p.controller, 2);
  visit(p.fade);
  visit(p.look_ahead_s);
  visit.choice(p.barrier.kind, 2);
  visit(p.barrier.separation_m);
  visit(p.barrier.contact_distance_m);
  visit(p.barrier.wall_distance_m);
  visit(p.barrier.no_fly_buffer_m);
  visit(p.barrier.u_max_m_s);
  visit(p.barrier.dt_s);
  visit(p.barrier.pair_gain);
  visit(p.barrier.wall_gain);
  visit(p.barrier.lag_s);
  visit(p.barrier.margin_m);
  visit(p.barrier.pair_margin_m);
  visit(p.barrier.sensing_range_m);
  visit(p.barrier.wall_range_m);
  visit(p.command_delay_s);
  visit(p.observation_delay_s);
  visit(p.only_active_are_obstacles);
  visit(p.health.tracking_timeout_s);
  visit(p.health.link_timeout_s);
  visit(p.health.battery_reserve);
  visit(p.health.recovery_s);
  visit(p.health.landed_height_m);
  visit(p.health.landing_s);
  visit(p.faults.watches);
  visit(p.faults.loop.gain);
  visit.limit(p.faults.loop.proportional_per_s);
  visit(p.faults.loop.integral_per_s2);
  visit(p.faults.loop.drag_per_s);
  visit(p.faults.loop.actuator_lag_s);
  visit.limit(p.faults.loop.acceleration_limit_m_s2);
  visit.limit(p.faults.loop.jerk_limit_m_s3);
  visit(p.faults.loop.response_delay_s);
  visit(p.faults.acceleration_limit_m_s2);
  visit(p.faults.bounds.longest_span_s);
  visit(p.faults.bounds.held_s);
  visit(p.faults.bounds.lost_share);
  visit(p.faults.bounds.reach_m_s);
  visit(p.faults.bounds.jump_m);
  visit(p.faults.bounds.confirm_s);
  visit(p.faults.bounds.frozen_s);
  visit(p.faults.bounds.never_repeats);
  visit(p.faults.bounds.residual_leak_per_s);
  visit(p.faults.bounds.residual_m);
  visit(p.faults.bounds.disagreement_leak_per_s);
  visit(p.faults.bounds.disagreement_m);
  visit(p.faults.bounds.drift_m_s);
  visit(p.faults.bounds.outside_m);
  visit(p.faults.bounds.silent_s);
  visit(p.faults.bounds.blind_s);
  visit.choice(p.first_intent, 9);
  visit.places(p.starts);
  visit.pads(p.recharge.pads);
  visit(p.recharge.take_off_s);
  visit(p.recharge.landing_s);
  visit(p.recharge.endurance_s);
}

}  // namespace vigil::recording
