#pragma once

#include "model/rolling_ball.h"

namespace fastball::model {

/// The same rigid ball from Newton's and Euler's equations in the world, all six degrees of freedom, without Eqs. (18) to (22):
/// the contact forces are those that keep the ball's surface at rest on the fingers' (rolling), or in touch with it while
/// friction mu N opposes the slip (sliding). On a plane the ball rolls along z' too, and the slip has any direction.
///
/// On two round fingers it only rolls, whatever friction that takes, until F'y comes to zero: how two rigid fingers share the
/// load, with any amount of squeeze between them, is not determined, and so is when one of them slips. The sum of their
/// forces, which the samples have, is. model/elastic_ball.h knows each.
/// @throw as rollOnFingers().
RollingMotion rollOnFingers3d(const BallParameters& ball,
                              const FingerPair& fingers,
                              const HandPath& hand_at,
                              const RollingTask& task);

}  // namespace fastball::model
