#pragma once

#include <lcm/lcm_coretypes.h>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "messaging/message_field.h"

namespace fastball::messaging {

/// The message types that a program can take apart without having been compiled for them: those of this project, and those of
/// every type library loaded. A type library is a shared library of the C code that `lcm-gen --c --c-typeinfo` makes
/// (cmake/TypeLibrary.cmake).
class TypeLibrary {
 public:
  struct Type {
    std::string name;  ///< as in C: package and struct, joined by underscores
    const lcm_type_info_t* info;
  };

  /// Knows the types of this project.
  TypeLibrary();
  /// Adds the types of a shared library, which stays loaded until the program ends.
  /// @return how many.
  /// @throw std::invalid_argument if it cannot be loaded or holds no type; names the path.
  int load(const std::string& path);

  /// The type of an encoded message by its fingerprint (its first eight bytes), or null.
  const Type* typeOf(const void* data, std::size_t size) const;
  /// Every member of an encoded message in the order of its declaration, those of nested types included. Any bytes are safe,
  /// and no length field makes it allocate more than a small multiple of `size`.
  /// @return nothing if the type is unknown or the bytes are not exactly one message of it.
  std::optional<std::vector<MessageField>> fields(const void* data, std::size_t size) const;

  /// The type that a member of `parent` calls by its last name, or null. Type information holds no package: the type whose name
  /// agrees longest with its parent's is taken.
  const Type* nested(const Type& parent, const std::string& last_name) const;

 private:
  void add(const std::string& name, const lcm_type_info_t* info);
  std::map<int64_t, Type> by_fingerprint_;
};

}  // namespace fastball::messaging
