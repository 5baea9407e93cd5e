#pragma once

#include "bench/contact_cases.h"
#include "config/experiment.h"
#include "model/elastic_ball.h"
#include "sim_bullet/config.h"

namespace fastball::bench {

/// How far the simulator's contacts (sim_bullet::BallContacts, the ball stepped by Bullet) are from a reference.
struct ContactError {
  double rolling = 0;    ///< [m], largest difference of x' up to the release
  double force = 0;      ///< [N], root mean square over time, of the finger for which it is larger
  double release = 0;    ///< [s], difference of the last touch
  double t_release = 0;  ///< [s], of the reference
  double distance = 0;   ///< [m], x' of the reference at its release
};

/// From model::elasticOnFingers, for the same motion of the hand and the same start: settled under the fingers' load.
/// @param step [s] of the simulator.
/// @throw std::runtime_error if the ball does not leave within the duration, here or there.
ContactError elasticError(const config::Experiment& experiment,
                          const sim_bullet::SimulationSettings& settings,
                          const ContactCase& contact,
                          double step);

/// From model::rollOnFingers, to which a hard ball comes near; up to a while before the rigid ball slips, where the friction of
/// two rigid fingers is not determined. The force is that of a single finger, of a groove 0.
ContactError rigidError(const config::Experiment& experiment,
                        const sim_bullet::SimulationSettings& settings,
                        const ContactCase& contact,
                        double step);

/// Kinetic energy [J] of the simulated ball before and after it has met the fingers of a still hand, no gravity, no drag.
struct Bounce {
  double before = 0, after = 0;
};
/// @param start as seen from the fingers; the ball must hit them and leave within the duration of the case, whose motion does
/// not count.
/// @throw std::runtime_error if it does not.
Bounce bounceOff(const config::Experiment& experiment,
                 const sim_bullet::SimulationSettings& settings,
                 const ContactCase& contact,
                 const model::ElasticStart& start,
                 double step);

}  // namespace fastball::bench
