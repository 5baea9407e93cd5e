#include "messaging/version.h"

namespace fastball::messaging {

const char* version() {
  return FASTBALL_VERSION;
}

}  // namespace fastball::messaging
