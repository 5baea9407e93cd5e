#include "launch/view/request_check.h"

#include <fmt/format.h>

#include <boost/asio/ip/address.hpp>

#include "messaging/heartbeat.h"

namespace fastball::view {
namespace {

namespace http = boost::beast::http;

std::string textOf(const http::fields& fields, boost::beast::string_view name) {
  const auto field = fields.find(name);
  return field == fields.end() ? "" : std::string(field->value());
}

/// "[::1]:80" and "localhost:80" without their port.
std::string withoutPort(const std::string& host) {
  if (!host.empty() && host.front() == '[')
    return host.substr(1, host.find(']') - 1);
  return host.substr(0, host.find(':'));
}

bool isAddress(const std::string& host) {
  boost::system::error_code error;
  boost::asio::ip::make_address(host, error);
  return !error;
}

/// A name that nobody else can make point here; an address needs no name at all.
bool ownName(const std::string& host, const Door& door) {
  if (host == "localhost" || host == door.host)
    return true;
  return door.local() ? host == "127.0.0.1" || host == "::1"
                      : isAddress(host) || host == messaging::hostName();
}

}  // namespace

bool Door::local() const {
  boost::system::error_code error;
  const auto address = boost::asio::ip::make_address(host, error);
  return !error && address.is_loopback();
}

std::string refusal(const http::fields& fields, const Door& door) {
  const std::string host = textOf(fields, "Host");
  if (!ownName(withoutPort(host), door))
    return fmt::format("this viewer is not called '{}'", host);
  const std::string origin = textOf(fields, "Origin");
  if (!origin.empty() && origin != "http://" + host)
    return fmt::format("requests from '{}' are not taken, only from http://{}", origin, host);
  const std::string site = textOf(fields, "Sec-Fetch-Site");
  const bool followed_link = textOf(fields, "Sec-Fetch-Mode") == "navigate";
  if (!site.empty() && site != "same-origin" && site != "none" && !followed_link)
    return "requests from another site's page are not taken";
  return "";
}

}  // namespace fastball::view
