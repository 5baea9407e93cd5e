#include "messaging/clock_survey.h"

#include <unistd.h>

#include "messaging/heartbeat.h"

namespace fastball::messaging {
namespace {

/// A question has no question before it.
bool isQuestion(const clock_probe_t& message) {
  return message.asked_utime == 0;
}

clock_probe_t signedBy(const std::string& name) {
  clock_probe_t message{};
  message.name = name;
  message.host = hostName();
  message.pid = getpid();
  return message;
}

}  // namespace

ClockAnswer::ClockAnswer(Endpoint& endpoint, const Clock& clock, const std::string& name)
    : clock_(clock), publisher_(endpoint, kClock), message_(signedBy(name)) {
  endpoint.subscribe<clock_probe_t>(kClock, [this](const clock_probe_t& question) {
    if (!isQuestion(question))
      return;
    message_.heard_utime = clock_.wallUs();
    message_.asked_utime = question.utime;
    message_.asker_host = question.host;
    message_.asker_pid = question.pid;
    message_.utime = clock_.wallUs();
    publisher_.publish(message_);
  });
}

ClockSurvey::ClockSurvey(Endpoint& endpoint, const Clock& clock)
    : clock_(clock), publisher_(endpoint, kClock), question_(signedBy("clock_survey")) {
  endpoint.subscribe<clock_probe_t>(kClock, [this](const clock_probe_t& m) {
    if (!isQuestion(m) && m.asker_host == question_.host && m.asker_pid == question_.pid)
      hear(m);
  });
}

void ClockSurvey::ask() {
  question_.utime = clock_.wallUs();
  publisher_.publish(question_);
}

void ClockSurvey::hear(const clock_probe_t& answer) {
  const int64_t heard_us = clock_.wallUs();
  const int64_t round_us = (heard_us - answer.asked_utime) - (answer.utime - answer.heard_utime);
  if (round_us < 0)
    return;  // a clock was set meanwhile
  HostClock& host = clocks_[answer.host];
  const double error = static_cast<double>(round_us) / 2e6;
  if (++host.answers > 1 && error >= host.error)
    return;
  host.error = error;
  // In whole microseconds first: doubles do not hold the difference of two dates to one.
  host.offset =
      static_cast<double>((answer.heard_utime - answer.asked_utime) + (answer.utime - heard_us)) /
      2e6;
}

}  // namespace fastball::messaging
