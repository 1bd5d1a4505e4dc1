#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Networks from elsewhere: the same one as ONNX, safetensors and state dictionary is the same header, and what cannot be
served is refused with what can. Usage: networks_in_test.py BIN_DIRECTORY PACKAGE_DIRECTORY"""

import os
import unittest

from package_case import PackageCase, some_network

import numpy
import onnx
import striker
import torch
from onnx import helper, numpy_helper


def onnx_model(nodes, constants, inputs=6, outputs=3, more_outputs=()):
    values = [helper.make_tensor_value_info(name, onnx.TensorProto.FLOAT, [1, size])
              for name, size in (("state", inputs), ("q", outputs))]
    graph = helper.make_graph(nodes, "network", values[:1], [*values[1:], *more_outputs],
                              [numpy_helper.from_array(array, name) for name, array in constants.items()])
    return helper.make_model(graph)


def layers_of(network):
    return sorted(name.removesuffix(".weight") for name in network if name.endswith(".weight"))


def gemm_chain(network, **attributes):
    nodes, value = [], "state"
    for layer in layers_of(network):
        last = layer == layers_of(network)[-1]
        nodes.append(helper.make_node("Gemm", [value, f"{layer}.weight", f"{layer}.bias"], ["q" if last else f"{layer}.s"],
                                      transB=1, **attributes))
        if not last:
            nodes.append(helper.make_node("Relu", [f"{layer}.s"], [f"{layer}.r"]))
            value = f"{layer}.r"
    return nodes, dict(network)


def matmul_chain(network):
    """As Keras exports: weights the other way round, biases added, on either side."""
    nodes, constants, value = [helper.make_node("Identity", ["state"], ["i"])], {}, "i"
    for layer in layers_of(network):
        last = layer == layers_of(network)[-1]
        constants[f"{layer}.w"] = numpy.ascontiguousarray(network[f"{layer}.weight"].T)
        constants[f"{layer}.b"] = network[f"{layer}.bias"]
        nodes.append(helper.make_node("MatMul", [value, f"{layer}.w"], [f"{layer}.m"]))
        added = [f"{layer}.m", f"{layer}.b"] if layer != "2" else [f"{layer}.b", f"{layer}.m"]
        nodes.append(helper.make_node("Add", added, ["q" if last else f"{layer}.s"]))
        if not last:
            nodes.append(helper.make_node("Relu", [f"{layer}.s"], [f"{layer}.r"]))
            value = f"{layer}.r"
    return nodes, constants


class NetworksIn(PackageCase):
    def header_of(self, model):
        """Without its comment."""
        self.must_run("striker-export", self.path(model), "-o", self.path("p.hpp"))
        with open(self.path("p.hpp"), encoding="utf-8") as stream:
            return [line for line in stream if not line.startswith("//")]

    def torch_network(self, hidden=(32, 32)):
        torch.manual_seed(3)
        widths, layers = (6, *hidden, 3), []
        for reads, makes in zip(widths, widths[1:]):
            layers += [torch.nn.Linear(reads, makes), torch.nn.ReLU()]
        return torch.nn.Sequential(*layers[:-1])

    def save(self, model, name="m.onnx"):
        onnx.save(model, self.path(name))
        return self.path(name)

    def refused(self, model, said):
        result = self.run_tool("striker-evaluate", "--model", self.save(model), "--episodes", 1, "--seed", 1)
        self.assertEqual(result.returncode, 2, result.stdout)
        self.assertRegex(result.stderr, said)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)

    def test_the_same_network_is_the_same_header(self):
        """Of one, two and three hidden layers, one of them as narrow as can be."""
        for hidden, form, also in (((32, 32), "Policy<6, 32, 32, 3, 16> p", ["matmul.onnx"]),
                                   ((24,), "Policy1<6, 24, 3, 16> p", []),
                                   ((24, 1, 17), "Policy3<6, 24, 1, 17, 3, 16> p", [])):
            with self.subTest(hidden):
                module = self.torch_network(hidden)
                striker.export(module.state_dict(), self.path("torch.safetensors"))
                arrays = {name: tensor.numpy() for name, tensor in module.state_dict().items()}
                torch.onnx.export(module, torch.zeros(1, 6), self.path("torch.onnx"))
                self.save(onnx_model(*matmul_chain(arrays)), "matmul.onnx")
                self.save(onnx_model(*gemm_chain(arrays)), "gemm.onnx")
                self.assertEqual(len({striker.Network(self.path(name)).identity for name in (
                    "torch.safetensors", "torch.onnx", "matmul.onnx", "gemm.onnx")}), 1)
                expected = self.header_of("torch.safetensors")
                self.assertIn(f"inline constexpr {form} = {{\n", expected)
                for other in ["torch.onnx", *also]:
                    self.assertEqual(self.header_of(other), expected, other)

    def test_the_same_network_has_the_same_identity(self):
        module = self.torch_network()
        striker.export(module.state_dict(), self.path("torch.safetensors"))
        expected = striker.Network(self.path("torch.safetensors")).identity
        arrays = {f"q_net.{name}": tensor.numpy() for name, tensor in module.state_dict().items()}
        others = {f"q_net_target.{name}": array for name, array in some_network().items()}
        striker.export({**arrays, **others}, self.path("arrays.safetensors"))
        self.assertEqual(striker.Network(self.path("arrays.safetensors")).identity, expected)
        self.assertNotEqual(striker.Network(self.path("arrays.safetensors"), "q_net_target").identity, expected)
        self.save(onnx_model(*gemm_chain({name: tensor.numpy() for name, tensor in module.state_dict().items()})))
        self.assertEqual(striker.Network(self.path("m.onnx")).identity, expected)

    def test_it_chooses_as_torch_does(self):
        module = self.torch_network()
        torch.onnx.export(module, torch.zeros(1, 6), self.path("torch.onnx"))
        states = torch.randn(500, 6)
        network = striker.Network(self.path("torch.onnx"))
        values = module(states).detach().numpy()
        numpy.testing.assert_allclose([network.values(state) for state in states.numpy()], values, atol=1e-5)
        self.assertGreater(numpy.mean(network(states.numpy()) == values.argmax(1)), 0.99)

    def test_one_and_three_hidden_layers_are_computed_as_torch_does(self):
        for hidden in ((24,), (20, 1, 12)):
            module = self.torch_network(hidden)
            striker.export(module.state_dict(), self.path("m.safetensors"))
            torch.onnx.export(module, torch.zeros(1, 6), self.path("m.onnx"))
            states = torch.randn(300, 6)
            values = module(states).detach().numpy()
            identities = set()
            for name in ("m.safetensors", "m.onnx"):
                network = striker.Network(self.path(name))
                identities.add(network.identity)
                numpy.testing.assert_allclose([network.values(state) for state in states.numpy()], values, atol=1e-5)
            self.assertEqual(len(identities), 1)

    def test_equal_biases_that_torch_writes_once(self):
        module = self.torch_network((16, 16))
        for number in (0, 2):
            torch.nn.init.zeros_(module[number].bias)
        striker.export(module.state_dict(), self.path("m.safetensors"))
        torch.onnx.export(module, torch.zeros(1, 6), self.path("m.onnx"))
        self.assertIn("Identity", [node.op_type for node in onnx.load(self.path("m.onnx")).graph.node])
        self.assertEqual(striker.Network(self.path("m.onnx")).identity, striker.Network(self.path("m.safetensors")).identity)

    def test_tensors_of_torch_that_numpy_does_not_know(self):
        state = self.torch_network().state_dict()
        rounded = {name: tensor.bfloat16() for name, tensor in state.items()}
        identities = set()
        for tensors in (rounded, {name: tensor.float() for name, tensor in rounded.items()}):
            striker.export(tensors, self.path("m.safetensors"))
            identities.add(striker.Network(self.path("m.safetensors")).identity)
        self.assertEqual(len(identities), 1)
        for changed in (state["2.weight"].to_sparse(), state["2.weight"].to("meta")):
            self.assertRaisesRegex(TypeError, "^tensor '2.weight': ", striker.export, {**state, "2.weight": changed},
                                   self.path("m.safetensors"))

    def test_metadata_of_onnx_names_the_task(self):
        model = onnx_model(*gemm_chain(some_network(inputs=2)), inputs=2)
        helper.set_model_props(model, {"configuration": striker.KickEnv(inputs=["ball_x", "ball_y"]).configuration})
        self.must_run("striker-evaluate", "--model", self.save(model), "--episodes", 2, "--seed", 1)

    def test_chains_that_are_none_are_refused_with_what_is_read(self):
        network = some_network()
        reads = "Gemm, or of MatMul and Add, with Relu between"

        def changed(change):
            nodes, constants = gemm_chain(network)
            change(nodes, constants)
            return onnx_model(nodes, constants)

        def tanh(nodes, _):
            nodes[1].op_type = "Tanh"

        def leaky(nodes, _):
            nodes[3].op_type = "LeakyRelu"

        def convolution(nodes, _):
            nodes[2].op_type = "Conv"

        def no_relu(nodes, _):
            nodes[1].op_type = "Identity"

        def fork(nodes, _):
            nodes.append(helper.make_node("Relu", ["0.s"], ["unused"]))

        def double(_, constants):
            constants["2.weight"] = constants["2.weight"].astype(numpy.float64)

        def nothing_there(_, constants):
            del constants["2.weight"]

        def not_finite(_, constants):
            constants["4.bias"] = numpy.array([0, numpy.nan, 0], numpy.float32)

        def circle(nodes, _):
            nodes[2] = helper.make_node("Identity", ["0.r"], ["state"])

        def open_end(nodes, _):
            nodes.pop()

        for change, said in ((tanh, "Tanh"), (leaky, "LeakyRelu"), (convolution, "Conv"), (no_relu, "without a Relu"), (fork, "no chain"), (double, "not FLOAT"),
                             (nothing_there, "2.weight, which is no constant"), (not_finite, "NaN"),
                             (circle, "circle"), (open_end, "no node makes")):
            with self.subTest(change.__name__):
                self.refused(changed(change), f"m.onnx: .*{said}.*{reads}")
        self.refused(onnx_model(*gemm_chain(network, alpha=0.5)), "alpha other than 1")
        two = helper.make_tensor_value_info("2.s", onnx.TensorProto.FLOAT, [1, 32])
        self.refused(onnx_model(*gemm_chain(network), more_outputs=[two]), "2 outputs")
        self.refused(onnx_model([helper.make_node("Gemm", ["state", "w", "b"], ["q"], transB=1)],
                                {"w": network["0.weight"][:3], "b": network["0.bias"][:3]}), "1 layer;.*one, two or three hidden")
        deep = {f"{2 * layer}.{part}": network[f"{name}.{part}"] for part in ("weight", "bias")
                for layer, name in enumerate("02224")}
        self.refused(onnx_model(*gemm_chain(deep)), "5 layers;.*one, two or three hidden")
        del deep["4.weight"], deep["4.bias"]  # as many as there may be
        self.must_run("striker-evaluate", "--model", self.save(onnx_model(*gemm_chain(deep))), "--episodes", 1, "--seed", 1)
        narrow = {**network, "2.weight": network["2.weight"][:, :31]}
        self.refused(onnx_model(*gemm_chain(narrow)), r"2.weight has shape \[32, 31\], not \[32, 32\]")

    def test_what_is_no_onnx_file_is_refused(self):
        for content in (b"", b"nothing of the kind", onnx_model(*gemm_chain(some_network())).SerializeToString()[:900]):
            with open(self.path("m.onnx"), "wb") as stream:
                stream.write(content)
            result = self.run_tool("striker-export", self.path("m.onnx"), "-o", self.path("p.hpp"))
            self.assertEqual(result.returncode, 2)
            self.assertRegex(result.stderr, "no ONNX file, or a damaged one")
        self.assertFalse(os.path.exists(self.path("p.hpp")))

    def test_a_state_dictionary_that_cannot_be_served_writes_nothing(self):
        deep = {**some_network(), **{f"{layer}.{part}": numpy.zeros((3, 3)[:size]) for layer in (6, 8)
                                     for part, size in (("weight", 2), ("bias", 1))}}
        shallow = {name: array for name, array in some_network().items() if name.startswith("0.")}
        wrong = {**some_network(), "2.bias": numpy.zeros(31)}
        infinite = {**some_network(), "4.bias": numpy.array([0, numpy.inf, 0])}
        for network, said in ((deep, "5 layers.*one, two or three hidden"), (shallow, "1 layer;.*one, two or three hidden"), (wrong, "2.weight has shape"), (infinite, "4.bias.*NaN"),
                              ({}, "no network")):
            self.assertRaisesRegex(RuntimeError, f"m.safetensors: .*{said}", striker.export, network,
                                   self.path("m.safetensors"))
            self.assertEqual(os.listdir(self.directory), [])


if __name__ == "__main__":
    unittest.main(verbosity=2)
