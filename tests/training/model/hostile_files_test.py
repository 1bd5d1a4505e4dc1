#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Whatever a file holds that is given as a model or a policy: one line that names it, exit status 2, no crash, and no more
memory than a model takes. Usage: hostile_files_test.py BIN_DIRECTORY"""

import json
import os
import resource
import struct
import subprocess
import sys
import tempfile
import unittest

import numpy
import onnx
from onnx import TensorProto, helper, numpy_helper

BIN = sys.argv.pop(1)
KICK = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../firmware/policy/exported/kick.hpp")
MEMORY_BYTES = 1 << 30  # of addresses: a program that asks for more is refused them, and ends otherwise than with 2


def weights(hidden=32):
    random = numpy.random.default_rng(1)
    network = {}
    for name, shape in (("0", (hidden, 6)), ("2", (hidden, hidden)), ("4", (3, hidden))):
        network[f"{name}.weight"] = random.normal(0, 0.3, shape).astype(numpy.float32)
        network[f"{name}.bias"] = random.normal(0, 0.1, shape[0]).astype(numpy.float32)
    return network


def safetensors(network, change=lambda header: None):
    header, data = {}, b""
    for name, array in network.items():
        raw = array.astype("<f4").tobytes()
        header[name] = {"dtype": "F32", "shape": list(array.shape), "data_offsets": [len(data), len(data) + len(raw)]}
        data += raw
    change(header)
    text = json.dumps(header).encode()
    return struct.pack("<Q", len(text)) + text + data


def only_header(text, length=None):
    return struct.pack("<Q", len(text) if length is None else length) + text


def gemms(constants, layers=3):
    """A chain of Gemm and Relu that reads `constants` ("0.weight" and so on), the first ones again where there are fewer."""
    names, nodes, value = [name[:-7] for name in constants if name.endswith(".weight")], [], "state"
    for layer in range(layers):
        name, made = names[layer % len(names)], "q" if layer == layers - 1 else f"a{layer}"
        nodes.append(helper.make_node("Gemm", [value, f"{name}.weight", f"{name}.bias"], [made], transB=1))
        if layer < layers - 1:
            nodes.append(helper.make_node("Relu", [made], [f"r{layer}"]))
        value = f"r{layer}"
    return nodes


def onnx_model(nodes, constants, sizes=(6, 3)):
    values = [helper.make_tensor_value_info(name, TensorProto.FLOAT, [1, size]) for name, size in zip(("state", "q"), sizes)]
    tensors = [array if isinstance(array, TensorProto) else numpy_helper.from_array(array, name)
               for name, array in constants.items()]
    return helper.make_model(helper.make_graph(nodes, "network", values[:1], values[1:], tensors))


def tensor(name, dims, **fields):
    return TensorProto(name=name, data_type=TensorProto.FLOAT, dims=dims, **fields)


class HostileFiles(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = directory.name

    def path(self, name):
        return os.path.join(self.directory, name)

    def write(self, name, content):
        with open(self.path(name), "wb") as stream:
            stream.write(content.SerializeToString() if isinstance(content, onnx.ModelProto) else content)
        return self.path(name)

    def run_tool(self, program, *arguments):
        return subprocess.run([os.path.join(BIN, program), *arguments], capture_output=True, text=True, check=False,
                              timeout=120,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES)))

    def refused(self, file, said, *, program="striker-export", named=None):
        """By a program that reads models: the line names the file and says why."""
        arguments = {"striker-export": [file, "-o", self.path("made.hpp")],
                     "striker-evaluate": ["--model", file, "--episodes", "1", "--seed", "1"],
                     "striker-sil": ["kick", "--episodes", "1", "--policy", file]}[program]
        result = self.run_tool(program, *arguments)
        about = f"{program} {file}: {result.returncode} {result.stderr[-300:]}"
        self.assertEqual(result.returncode, 2, about)
        self.assertRegex(result.stderr, said, about)
        self.assertIn(file if named is None else named, result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1, about)
        self.assertLess(len(result.stderr), 1500, about)
        self.assertFalse(os.path.exists(self.path("made.hpp")))

    def test_the_memory_that_is_allowed_is_enough_for_a_model(self):
        self.write("m.safetensors", safetensors(weights()))
        self.write("m.onnx", onnx_model(gemms(weights()), weights()))
        for name in ("m.safetensors", "m.onnx"):
            played = self.run_tool("striker-evaluate", "--model", self.path(name), "--episodes", "1", "--seed", "1")
            self.assertEqual(played.returncode, 0, played.stderr)
        played = self.run_tool("striker-sil", "kick", "--episodes", "1", "--policy", KICK)
        self.assertEqual(played.returncode, 0, played.stderr)

    def test_what_is_no_file_of_that_kind(self):
        os.mkdir(self.path("folder.safetensors"))
        os.symlink(self.path("nowhere"), self.path("broken.onnx"))
        os.symlink("loop.onnx", self.path("loop.onnx"))
        os.symlink("/dev/zero", self.path("zero.onnx"))
        os.symlink("/dev/zero", self.path("zero.hpp"))
        with open(self.path("sparse.safetensors"), "wb") as stream:
            stream.truncate(1 << 32)
        os.symlink("sparse.safetensors", self.path("sparse.onnx"))
        os.symlink("sparse.safetensors", self.path("sparse.hpp"))
        for name, said in (("folder.safetensors", "folder"), ("broken.onnx", "file that is there"), ("loop.onnx", "file that is there"),
                           ("/dev/zero", "MiB"), ("zero.onnx", "MiB"), ("sparse.safetensors", "MiB"), ("sparse.onnx", "MiB"),
                           ("/proc/self/mem", "cannot be read")):
            for program in ("striker-export", "striker-evaluate"):
                self.refused(self.path(name), said, program=program)
        for name in ("zero.hpp", "sparse.hpp"):
            self.refused(self.path(name), "MiB", program="striker-sil")

    def test_a_model_for_another_task(self):
        network = weights()
        narrow = {**network, "0.weight": network["0.weight"][:, :5]}
        file = self.write("m.safetensors", safetensors(narrow))
        for program in ("striker-export", "striker-evaluate"):
            self.refused(file, "m.safetensors: the network has 5 inputs and 3 actions.*--config", program=program)
        for text, said in (("[task]\nkind = \"x\"", "kick"), ("\0", "line 1")):
            file = self.write("m.safetensors", safetensors(network, lambda header, text=text: header.update(__metadata__={"configuration": text})))
            self.refused(file, f"m.safetensors, the configuration in it: .*{said}")

    def test_safetensors_that_lie(self):
        network = weights()
        whole = safetensors(network)
        for content, said in (
                (b"", "truncated"), (whole[:7], "truncated"), (whole[:100], "truncated"), (whole[:-1], "truncated"),
                (whole + b"\0\0\0\0", "belong to no tensor"), (only_header(b"{}", 2**64 - 1), "truncated or not"),
                (only_header(b"{}"), "no network"), (only_header(b"[]"), "not a JSON object"),
                (only_header(b"\xff\xfe{}"), "not a JSON object"), (only_header(b"1e999"), "not a JSON object"),
                (only_header(b'{"a":' * 100_000), "deep"), (only_header(b"[" * 8_000_000), "deep"),
                (only_header(b"[" * 9_000_000), "header has 9000000 bytes"),
                (only_header(b"{\"__metadata__\":[" + b"[]," * 7_000_000 + b"0]}"), "header"),
                (only_header(b'{"0.weight":null}'), "dtype"),
                (only_header(b'{"0.weight":{"dtype":"F32","shape":[-1],"data_offsets":[0,0]}}'), "not a size"),
                (only_header(b'{"0.weight":{"dtype":"F32","shape":[1e3],"data_offsets":[0,0]}}'), "not a size"),
                (only_header(b'{"0.weight":{"dtype":"F32","shape":[],"data_offsets":[0,99999999999999999999]}}'), "not a size")):
            self.refused(self.write("m.safetensors", content), said)
        lies = {"F64": lambda h: h["2.weight"].update(dtype="F64"),
                "does not fit": lambda h: h["2.weight"].update(shape=[2**32, 2**32]),
                "outside the file": lambda h: h["2.weight"].update(data_offsets=[0, 2**63]),
                "overlap": lambda h: h["2.weight"].update(data_offsets=h["0.weight"]["data_offsets"],
                                                          shape=h["0.weight"]["shape"]),
                "1e": lambda h: h["2.weight"].update(shape=[1e300, 2])}
        for said, change in lies.items():
            self.refused(self.write("m.safetensors", safetensors(network, change)), said)

    def test_weights_that_no_network_has(self):
        def changed(name, array):
            return {**weights(), name: numpy.asarray(array, numpy.float32)}

        for value in (numpy.nan, numpy.inf, -numpy.inf):
            spoiled = weights()["2.weight"]
            spoiled[3, 4] = value
            network = changed("2.weight", spoiled)
            self.refused(self.write("m.safetensors", safetensors(network)), "tensor 2.weight holds NaN or infinite")
            self.refused(self.write("m.onnx", onnx_model(gemms(network), network)), "2.weight, which holds NaN or infinite")
        for name, shape in (("0.weight", (32, 0)), ("0.weight", (0, 6)), ("0.bias", (0,)), ("2.bias", (32, 1)),
                            ("2.weight", (32 * 32,)), ("4.bias", ()), ("4.weight", (3, 31))):
            network = changed(name, numpy.zeros(shape))
            self.refused(self.write("m.safetensors", safetensors(network)), "m.safetensors: ")
            self.refused(self.write("m.onnx", onnx_model(gemms(network), network)), "m.onnx: ")

    def test_a_weight_that_no_integer_holds_is_named_by_the_export(self):
        network = weights()
        network["2.weight"][3, 4] = 3e38
        file = self.write("m.safetensors", safetensors(network))
        exported = self.run_tool("striker-export", file, "-o", self.path("made.hpp"))
        self.assertEqual(exported.returncode, 2, exported.stderr)
        self.assertRegex(exported.stderr.splitlines()[-1], "m.safetensors: layer . cannot be quantised.*tensor ..weight, row")
        self.assertFalse(os.path.exists(self.path("made.hpp")))

    def test_names_that_want_to_be_more_than_a_name(self):
        for name in ("two\nlines", "\x1b[2Jred", "x" * 100_000, "0.weight\0hidden"):
            self.refused(self.write("m.safetensors", safetensors({name: numpy.zeros(3, numpy.float32)})), "the header's name")
            node = helper.make_node("Tanh", ["state"], ["q"], name=name)
            self.refused(self.write("m.onnx", onnx_model([node], {})), "Tanh")

    def test_onnx_that_lies(self):
        network = weights()
        model = onnx_model(gemms(network), network)
        whole = model.SerializeToString()
        for cut in (1, 20, len(whole) // 2, len(whole) - 1):
            self.refused(self.write("m.onnx", whole[:cut]), "ONNX|no constant|chain|node|input")

        def with_weight(**fields):
            return onnx_model(gemms(network), {**network, "2.weight": tensor("2.weight", **fields)})

        raw = network["2.weight"].tobytes()
        external = [onnx.StringStringEntryProto(key="location", value="/etc/passwd")]
        for content, said in (
                (with_weight(dims=[32, 32], data_location=TensorProto.EXTERNAL, external_data=external), "another file"),
                (with_weight(dims=[32, 32], raw_data=raw[:-1]), "2.weight"),
                (with_weight(dims=[32, 32], raw_data=raw + b"\0"), "2.weight"),
                (with_weight(dims=[2**62, 2**62], raw_data=raw), "2.weight"), (with_weight(dims=[-32, -32]), "2.weight"),
                (with_weight(dims=[32, 32]), "2.weight"), (with_weight(dims=[], float_data=[1.0]), "dimensions")):
            self.refused(self.write("m.onnx", content), said)
        nameless = onnx_model(gemms(network), network)
        nameless.graph.node.extend([onnx.NodeProto(op_type="Relu", input=["a0"])] * 2)
        self.refused(self.write("m.onnx", nameless), "no chain")
        bare = onnx_model([onnx.NodeProto(op_type="Relu", input=["state"])], {})
        self.refused(self.write("m.onnx", bare), "no node makes one value")
        foreign = onnx_model(gemms(network), network)
        foreign.graph.node[0].domain = "com.example"
        self.refused(self.write("m.onnx", foreign), "com.example")

    def test_a_small_onnx_file_that_would_be_a_big_one_in_memory(self):
        """Fields of two bytes each, of what takes some hundred as an object."""
        size = 40 << 20
        graph = onnx_model([], {}).graph.SerializeToString()

        def field(number, content):
            length, digits = len(content), b""
            while length > 127:
                digits, length = digits + bytes([length & 127 | 128]), length >> 7
            return bytes([number << 3 | 2]) + digits + bytes([length]) + content

        dims = b"\x01" * size  # a byte in the file, and eight in memory
        for content in (field(7, graph + b"\x0a\x00" * (size // 2)), field(7, graph + b"\x2a\x00" * (size // 2)),
                        field(7, graph + field(1, b"\x0a\x00" * (size // 2))), field(7, graph) + b"\x72\x00" * (size // 2),
                        field(7, graph + field(5, field(1, dims))), field(7, graph) + b"\x08\x01" * (size // 2)):
            self.refused(self.write("m.onnx", content), "bytes of names, nodes and notes.*Gemm")
        many = [helper.make_node("Identity", [f"{number}"], [f"{number + 1}"]) for number in range(20_000)]
        self.refused(self.write("m.onnx", onnx_model(many, {})), "20000 nodes; at most")
        big = {"0.weight": numpy.zeros((3000, 6), numpy.float32), "0.bias": numpy.zeros(3000, numpy.float32),
               "2.weight": numpy.zeros((3, 3000), numpy.float32), "2.bias": numpy.zeros(3, numpy.float32)}
        constants = [helper.make_node("Constant", [], [name], value=numpy_helper.from_array(array)) for name, array in big.items()]
        for nodes, kept in ((gemms(big, 2), big), (constants + gemms(big, 2), {})):  # numbers may take what they take
            played = self.run_tool("striker-evaluate", "--model", self.write("m.onnx", onnx_model(nodes, kept)), "--episodes", "1",
                                   "--seed", "1")
            self.assertEqual(played.returncode, 0, played.stderr)

    def test_an_onnx_file_that_can_be_read_in_two_ways(self):
        network = weights()

        def changed(change):
            model = onnx_model(gemms(network), network)
            change(model)
            return model

        attribute, floats, whole = onnx.AttributeProto, onnx.AttributeProto.FLOAT, onnx.AttributeProto.INT
        tanh = onnx.FunctionProto(name="Relu", input=["x"], output=["y"], node=[helper.make_node("Tanh", ["x"], ["y"])])
        for change, said in (
                (lambda m: m.graph.initializer.append(numpy_helper.from_array(network["2.weight"] * 2, "2.weight")), "2.weight is there twice"),
                (lambda m: m.graph.node.append(helper.make_node("Constant", [], ["0.bias"], value=numpy_helper.from_array(network["2.bias"]))), "0.bias is there twice"),
                (lambda m: m.graph.node.append(helper.make_node("Relu", ["x"], ["a1"])), "a1 is there twice"),
                (lambda m: m.graph.node[0].attribute.append(attribute(name="transB", type=whole, i=0)), "transB twice"),
                (lambda m: m.graph.node[0].attribute[0].CopyFrom(attribute(name="transB", type=floats, f=1.0)), "transB twice, or of another type"),
                (lambda m: m.graph.node[0].attribute.append(attribute(name="alpha", type=whole, i=1)), "alpha twice, or of another type"),
                (lambda m: m.functions.append(tanh), "says itself what Relu is")):
            self.refused(self.write("m.onnx", changed(change)), said)
        twice = {**network, "00.weight": network["0.weight"] * 2}
        self.refused(self.write("m.safetensors", safetensors(twice)), "0.weight and 00.weight are both weight of layer 0")

    def test_bytes_that_are_no_text_are_shown_as_text(self):
        whole = onnx_model([helper.make_node("Tanh", ["state"], ["q"], name="a name"), ], {}).SerializeToString()
        for bad in (b"\xff\xfe", b"\xc2\x9b", b"\xed\xa0\x80", b"\xf4\x90\x80\x80", b"\xc0\x80", b"a\xe9"):
            name = (bad + b"......")[:6]
            self.refused(self.write("m.onnx", whole.replace(b"a name", name)), rf"node [a?]+\.+ \(Tanh\)")
        self.refused(self.write("m.onnx", whole.replace(b"a name", "h\u00e9\u20ac".encode())), "node h\u00e9\u20ac ")

    def test_an_onnx_file_is_known_by_its_name_however_it_is_written(self):
        content = onnx_model(gemms(weights()), weights())
        for name in ("m.ONNX", "m.Onnx"):
            played = self.run_tool("striker-evaluate", "--model", self.write(name, content), "--episodes", "1", "--seed", "1")
            self.assertEqual(played.returncode, 0, played.stderr)
        for name in ("m", "m.safetensors"):
            self.refused(self.write(name, content), "may be an ONNX file: name it .onnx")

    def test_one_big_weight_that_many_layers_share(self):
        side = 2500
        network = {"0.weight": numpy.zeros((side, side), numpy.float32), "0.bias": numpy.zeros(side, numpy.float32)}
        self.refused(self.write("m.onnx", onnx_model(gemms(network, layers=400), network, (side, side))), "hidden layers")

    def test_headers_that_no_export_wrote(self):
        with open(KICK, encoding="utf-8") as stream:
            header = stream.read()
        begin = header.index("\ninline constexpr Policy<")
        body = header.index("{", begin)
        for content, said in (
                ("", "no policy"), (header[:begin + 40], "no policy"), (header[:body + 1], "damaged"),
                (header[:-2000], "damaged|out of range|fit"), ("\ninline constexpr Policy<" + "a" * 2_000_000, "no policy"),
                ("\ninline constexpr Policy<" + "a" * 2_000_000 + "> kick = {", "no policy"),
                ("\ninline constexpr Policy<6> " + "a" * 2_000_000 + " = {", "no policy"),
                (header[:body] + "{" * 4_000_000, "damaged"),
                (header[:body] + "{.state = " + "{ {" * 1_000_000 + "\n};", "damaged|deep"),
                (header[:body] + "{.identity = 0x" + "F" * 100_000 + "}\n};", "damaged"),
                (header[:body] + "{.identity = " + "9" * 100_000 + "}\n};", "damaged"),
                (header[:body] + "{.identity = true}\n};", "damaged"), (header[:body] + "{}\n};", "damaged"),
                (header.replace(".shift = ", ".shift = 9", 1), "range"),
                (header.replace(".decisions_ago = 0", ".decisions_ago = 200", 1), "range"),
                (header.replace("layer2", "layer1", 1), "damaged"),
                (header.replace("Policy<14, 96, 96", "Policy1<14, 96", 1), "damaged"),
                (header.replace("Policy<14, 96, 96", "Policy3<14, 96, 96, 96", 1), "damaged"),
                (header.replace("Policy<14, 96, 96", "Policy2<14, 96, 96", 1), "no policy"),
                (header.replace("Policy<14, 96, 96", "Policy<14, 96, 97", 1), "do not fit"),
                (header.replace("3, 16> kick", "3, 17> kick", 1), "do not fit"),
                (header.replace("3, 16> kick", "3, 16, std::int8_t> kick", 1), "range"), (header.replace("\n", "\r\n"), "no policy|damaged"),
                (header + "\0" * 1000 + header, None)):
            if said is not None:
                self.refused(self.write("p.hpp", content.encode()), said, program="striker-sil")

    def test_a_model_that_is_no_model_says_so_through_striker_sil_too(self):
        file = self.write("m.safetensors", only_header(b"{}"))
        result = self.run_tool("striker-sil", "kick", "--episodes", "1", "--policy", file)
        self.assertEqual(result.returncode, 2)
        self.assertEqual([file in line for line in result.stderr.splitlines()], [True, True])


if __name__ == "__main__":
    unittest.main(verbosity=2)
