// SPDX-License-Identifier: Apache-2.0
#include "sil/bus/in_process_link.hpp"

namespace striker::sil {

template class NodeLink<loop::BuiltInNode>;
template class NodeLink<loop::OrderedNode>;

}  // namespace striker::sil
