#include "hand_server/node.h"
#include "messaging/process.h"

int main(int argc, char** argv) {
  return fastball::messaging::processMain(argc, argv, "fastball-hand-server",
                                          "Grasps the ball, holds it, and lets it go in time.",
                                          fastball::hand_server::makeNode);
}
