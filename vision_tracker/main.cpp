#include "messaging/process.h"
#include "vision_tracker/node.h"

int main(int argc, char** argv) {
  return fastball::messaging::processMain(
      argc, argv, "fastball-vision-tracker",
      "Finds the ball in the cameras' images and says where it lands.",
      fastball::vision_tracker::makeNode);
}
