// SPDX-License-Identifier: Apache-2.0
// Owners of ODE's objects. Bodies and joints belong to their dWorld and need none.
#pragma once

#include <ode/ode.h>

#include <memory>
#include <type_traits>

namespace striker::sil {

template <auto Destroy>
struct OdeDeleter {
  template <typename Object>
  void operator()(Object* object) const {
    Destroy(object);
  }
};

using ThreadingHandle = std::unique_ptr<std::remove_pointer_t<dThreadingImplementationID>,
                                        OdeDeleter<dThreadingFreeImplementation>>;
using WorldHandle = std::unique_ptr<std::remove_pointer_t<dWorldID>, OdeDeleter<dWorldDestroy>>;
using GeomHandle = std::unique_ptr<std::remove_pointer_t<dGeomID>, OdeDeleter<dGeomDestroy>>;
using JointGroupHandle =
    std::unique_ptr<std::remove_pointer_t<dJointGroupID>, OdeDeleter<dJointGroupDestroy>>;

}  // namespace striker::sil
