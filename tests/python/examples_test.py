"""The examples in examples/python: MQTT with a real mosquitto, UDP with neat-python's stand-in (and its
configuration's lines counted)."""

import os
import pathlib
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import textwrap
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples/python"
MOSQUITTO = shutil.which("mosquitto", path=os.environ.get("PATH", "") + ":/usr/sbin")


def free_port(kind):
    with socket.socket(socket.AF_INET, kind) as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def has_paho():
    return subprocess.run([sys.executable, "-c", "import paho.mqtt.client"], capture_output=True,
                          check=False).returncode == 0


class MqttTest(unittest.TestCase):
    @unittest.skipUnless(MOSQUITTO and has_paho(), "needs mosquitto and paho")
    def test_islands_over_a_broker_hear_each_other(self):
        port = free_port(socket.SOCK_STREAM)
        with tempfile.TemporaryDirectory() as folder:
            settings = pathlib.Path(folder) / "mosquitto.conf"
            settings.write_text(f"listener {port} 127.0.0.1\nallow_anonymous true\n")
            broker = subprocess.Popen([MOSQUITTO, "-c", settings], stdout=subprocess.DEVNULL,
                                      stderr=subprocess.DEVNULL)
            try:
                while True:
                    with socket.socket() as one:
                        if one.connect_ex(("127.0.0.1", port)) == 0:
                            break
                    self.assertIsNone(broker.poll())
                    time.sleep(0.02)
                islands = [subprocess.Popen(
                    [sys.executable, "-B", EXAMPLES / "mqtt_islands.py", str(robot), "127.0.0.1",
                     str(port), "100"], stdout=subprocess.PIPE, text=True) for robot in (1, 2)]
                said = [one.communicate()[0] for one in islands]
            finally:
                broker.terminate()
                broker.wait()
        taken = [int(re.search(r"(\d+) genomes taken", text)[1]) for text in said]
        self.assertGreater(sum(taken), 20, said)


class UdpTest(unittest.TestCase):
    def test_integrating_takes_at_most_25_lines(self):
        text = (EXAMPLES / "udp_islands.py").read_text()
        own = text.split("# ---- begin: what Gene Clocks takes\n")[1].split("# ---- end")[0]
        lines = [line for line in own.splitlines() if line.strip()]
        lines += [line for line in text.splitlines() if "gene_clocks" in line and line.startswith("from")]
        self.assertLessEqual(len(lines), 25)

    def test_integer_ids_take_at_most_60_lines(self):
        text = (ROOT / "examples/integer_ids.cpp").read_text()
        own = text.split("// ---- begin: what Gene Clocks takes\n")[1].split("// ---- end")[0]
        self.assertLessEqual(sum(bool(line.strip()) for line in own.splitlines()), 60)

    def test_islands_hear_each_other(self):
        # neat-python's place is taken by its stand-in; the example is run as it is.
        ports = [free_port(socket.SOCK_DGRAM) for _ in range(2)]
        program = textwrap.dedent(f"""
            import sys, types
            sys.path.insert(0, {str(ROOT / 'tests/python')!r})
            import neat_stand_in
            sys.modules["neat"] = neat_stand_in
            robot, ports = int(sys.argv[1]), {ports}
            sys.argv[1:] = [str(robot), str(ports[robot - 1]), f"127.0.0.1:{{ports[2 - robot]}}"]
            import random, runpy, time
            random.seed(robot)
            example = runpy.run_path({str(EXAMPLES / 'udp_islands.py')!r})
            population = neat_stand_in.Population(neat_stand_in.Config())
            example["join"](population)
            def evaluate(genomes, config):
                for _, genome in genomes:
                    genome.fitness = random.random()
            for _ in range(3000):
                population.run(evaluate, 1)
                time.sleep(0.002)
                if population.reporters[0].taken >= 5:
                    break
            population.run(evaluate, 60)  # the other one may still be waiting
            print(population.reporters[0].taken)
        """)
        with tempfile.TemporaryDirectory() as folder:
            islands = [subprocess.Popen([sys.executable, "-B", "-c", program, str(robot)], cwd=folder,
                                        stdout=subprocess.PIPE, text=True) for robot in (1, 2)]
            taken = [int(one.communicate()[0]) for one in islands]
            self.assertTrue((pathlib.Path(folder) / "island-1/counter.1").exists())
        self.assertGreaterEqual(min(taken), 5)


if __name__ == "__main__":
    unittest.main()
