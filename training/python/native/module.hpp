// SPDX-License-Identifier: Apache-2.0
// What the extension module striker._native is made of: each function adds its classes. striker/ is what Python's
// users see; nothing here is called by them.
#pragma once

#include <pybind11/pybind11.h>

namespace striker::training {

void add_kick(pybind11::module_& module);     // Kick, KickWorlds
void add_match(pybind11::module_& module);    // Match
void add_network(pybind11::module_& module);  // Network, and the task that a model or a configuration is for

}  // namespace striker::training
