#include "launch/figures/figure.h"
#include "launch/figures/recorded_throw.h"
#include "launch/release_drawing.h"

namespace fastball::launch {

std::string drawReleasePicture(const FigureTask& task) {
  return "One throw by the strategy \"paper\", drawn from what its run says of it. " +
         drawRelease(recordedThrow(task.config, "paper"), task.experiment, "Strategy \"paper\"",
                     task.folder + "/fig12");
}

}  // namespace fastball::launch
