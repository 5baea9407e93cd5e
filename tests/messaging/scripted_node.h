#pragma once

#include <functional>
#include <string>

#include "messaging/node.h"

namespace fastball::messaging {

/// A node whose every part a test can set.
class ScriptedNode : public Node {
 public:
  explicit ScriptedNode(std::string its_name = "scripted") : name_(std::move(its_name)) {}

  std::string name() const override { return name_; }
  void step() override {
    ++steps;
    if (on_step)
      on_step();
  }
  int64_t wakeUs() const override { return wake_us; }
  NodeState state() const override { return node_state; }
  bool finished() const override { return is_finished; }
  void shutDown() override {
    ++shut_downs;
    if (on_shut_down)
      on_shut_down();
  }

  std::function<void()> on_step;
  std::function<void()> on_shut_down;
  int64_t wake_us = INT64_MAX;
  NodeState node_state;
  bool is_finished = false;
  int steps = 0;
  int shut_downs = 0;

 private:
  std::string name_;
};

}  // namespace fastball::messaging
