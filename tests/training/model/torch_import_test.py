#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""A Q network that PyTorch trained and somebody saved as safetensors: read, played and exported.
Usage: torch_import_test.py BIN_DIRECTORY"""

import json
import os
import struct
import subprocess
import sys
import tempfile
import unittest

import torch

BIN = sys.argv.pop(1)


def save_safetensors(tensors, file):
    """As the safetensors library writes it; Debian has none."""
    header, data = {}, b""
    for name, tensor in tensors.items():
        raw = tensor.detach().contiguous().numpy().astype("<f4").tobytes()
        header[name] = {"dtype": "F32", "shape": list(tensor.shape), "data_offsets": [len(data), len(data) + len(raw)]}
        data += raw
    text = json.dumps(header).encode()
    with open(file, "wb") as stream:
        stream.write(struct.pack("<Q", len(text)) + text + data)


def network(inputs, hidden, actions):
    return torch.nn.Sequential(torch.nn.Linear(inputs, hidden), torch.nn.ReLU(), torch.nn.Linear(hidden, hidden),
                               torch.nn.ReLU(), torch.nn.Linear(hidden, actions))


class TorchImport(unittest.TestCase):
    def setUp(self):
        torch.manual_seed(1)
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = directory.name

    def path(self, name):
        return os.path.join(self.directory, name)

    def run_tool(self, tool, *arguments):
        return subprocess.run([os.path.join(BIN, tool), *arguments], capture_output=True, text=True, check=False)

    def test_the_same_choices_as_in_torch(self):
        model = network(6, 64, 3)
        save_safetensors(model.state_dict(), self.path("m.safetensors"))
        units = torch.tensor([1e-6 / 2.0, 1e-6 / 2.0, 1e-3 / 2.55, 1e-3 / 2.55, 1e-3 / 2.55, 1.0 / 32768])
        raw = torch.randint(-30000, 30001, (500, 6)) * torch.tensor([60, 60, 1, 1, 1, 1])
        chosen = model(raw * units).argmax(1).tolist()
        with open(self.path("d.csv"), "w", encoding="utf-8") as stream:
            stream.write("episode,decision,before_contact,action,ball_x_um,ball_y_um,robot_speed_mm_s,ball_vx_mm_s,"
                         "ball_vy_mm_s,ball_angle\n")
            for action, state in zip(chosen, raw.tolist()):
                stream.write(",".join(str(number) for number in [0, 0, 1, action, *state]) + "\n")
        result = self.run_tool("striker-evaluate", "--model", self.path("m.safetensors"), "--decisions",
                               self.path("d.csv"), "--json", self.path("r.json"))
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(self.path("r.json"), encoding="utf-8") as stream:
            report = json.load(stream)
        self.assertEqual(report["states"], 500)
        self.assertGreaterEqual(report["agreement"], 0.998)  # ties to the last bit of float32
        self.assertLess(report["mean_regret"], 1e-6)

    def test_it_plays_and_becomes_a_header(self):
        names = {f"q_net.q_net.{name}": tensor for name, tensor in network(6, 32, 3).state_dict().items()}
        names.update({f"q_net_target.q_net.{name}": tensor for name, tensor in network(6, 32, 3).state_dict().items()})
        save_safetensors(names, self.path("sb3.safetensors"))
        played = self.run_tool("striker-evaluate", "--model", self.path("sb3.safetensors"), "--episodes", "5",
                               "--seed", "1")
        self.assertEqual(played.returncode, 0, played.stderr)
        exported = self.run_tool("striker-export", self.path("sb3.safetensors"), "-o", self.path("p.hpp"))
        self.assertEqual(exported.returncode, 0, exported.stderr)
        with open(self.path("p.hpp"), encoding="utf-8") as stream:
            self.assertIn("Policy<6, 32, 32, 3, 16> ", stream.read())

    def test_another_task_wants_its_configuration(self):
        save_safetensors(network(10, 64, 3).state_dict(), self.path("acs.safetensors"))
        arguments = ["--model", self.path("acs.safetensors"), "--episodes", "2", "--seed", "1"]
        refused = self.run_tool("striker-evaluate", *arguments)
        self.assertEqual(refused.returncode, 2)
        self.assertIn("--config", refused.stderr)
        with open(self.path("acs.toml"), "w", encoding="utf-8") as stream:
            stream.write('[task]\ninputs = "acs"\n')
        played = self.run_tool("striker-evaluate", *arguments, "--config", self.path("acs.toml"))
        self.assertEqual(played.returncode, 0, played.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
