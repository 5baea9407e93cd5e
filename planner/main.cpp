#include "messaging/process.h"
#include "planner/node.h"

int main(int argc, char** argv) {
  return fastball::messaging::processMain(argc, argv, "fastball-planner",
                                          "Plans the swing that throws the ball into the net.",
                                          fastball::planner::makeNode);
}
