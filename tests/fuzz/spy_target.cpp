// What `fastball spy` and the type library make of any bytes.
#include <nlohmann/json.hpp>
#include <optional>

#include "launch/replay_comparison.h"
#include "launch/spy/field_summary.h"
#include "launch/spy/traffic_text.h"
#include "tests/fuzz/node_target.h"

namespace fastball {
namespace {

/// All that is shown of the channels.
void show(const launch::Traffic& traffic, int64_t now) {
  const auto reports = traffic.report(now);
  launch::trafficTable(reports, 100);
  for (const launch::ChannelReport& report : reports) {
    const auto fields = traffic.newestFields(report.channel);
    launch::fieldLines(fields);
    launch::toJson(report, fields, now)
        .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  }
}

/// Sums up every value, so that a sanitizer sees each read.
double readAll(const std::vector<messaging::MessageField>& fields) {
  double sum = 0;
  for (const messaging::MessageField& field : fields) {
    for (std::size_t i = 0; i < field.count(); ++i)
      sum += field.isText() ? static_cast<double>(field.text(i).size()) : field.number(i);
    if (field.count() > 0 &&
        field.indexOf(field.elementName(field.count() - 1)) != field.count() - 1)
      fuzz::die(field.name() + " does not find its last value");
  }
  return sum;
}

}  // namespace
}  // namespace fastball

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  using namespace fastball;
  static const messaging::TypeLibrary types;
  launch::Traffic traffic(types);
  // It makes a type library of its own, which takes longer than all the rest.
  constexpr int kLifetime = 1000;  // inputs
  static std::optional<launch::MessageComparison> comparison;
  static int age = 0;
  if (!comparison || ++age % kLifetime == 0)
    comparison.emplace();
  int64_t now = 0;
  for (const fuzz::Said& said : fuzz::parse(data, size)) {
    now += fuzz::pauseUs(said.pause);
    traffic.take(said.channel, said.message.data(), said.message.size(), now);
    if (const auto fields = types.fields(said.message.data(), said.message.size()))
      readAll(*fields);
    const std::vector<char> bytes(said.message.begin(), said.message.end());
    comparison->isAnswer(bytes);
    comparison->record(said.channel, bytes);
    comparison->say(said.channel, bytes);
  }
  show(traffic, now);
  return 0;
}
