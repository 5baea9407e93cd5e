#pragma once

#include <boost/beast/http/fields.hpp>
#include <string>

namespace fastball::view {

/// Who may talk to the server.
struct Door {
  std::string host;  ///< address that it is bound to
  unsigned short port = 0;

  /// True if only this machine can reach it.
  bool local() const;
};

/// Why a request is refused, or empty. Another site's page in the same browser can send requests here: they carry that site as
/// Origin, are marked by Sec-Fetch-Site, or, where that site's name has been made to point here (DNS rebinding), carry its name
/// as Host.
std::string refusal(const boost::beast::http::fields& fields, const Door& door);

}  // namespace fastball::view
