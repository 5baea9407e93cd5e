#pragma once

namespace fastball::test_kit {

/// How often this program has asked for memory: a test that has allocation_count.cpp among its sources counts every operator new.
long allocations();

}  // namespace fastball::test_kit
