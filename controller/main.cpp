#include "controller/node.h"
#include "messaging/process.h"

int main(int argc, char** argv) {
  return fastball::messaging::processMain(argc, argv, "fastball-controller",
                                          "Makes the arm follow a swing plan, tick by tick.",
                                          fastball::controller::makeNode);
}
