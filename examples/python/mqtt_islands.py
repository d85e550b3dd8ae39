#!/usr/bin/env python3
"""Islands over MQTT: mqtt_islands.py ROBOT BROKER PORT GENOMES

A NEAT stands in for yours: each island makes genomes of random weights, and sends them. Frames are not
retained; quality of service 0 or 1 will do, since a frame that comes twice does no harm."""

import queue
import random
import sys
import time

import paho.mqtt.client as mqtt

from gene_clocks import GeneClass, Genes, Genome, Schema, float64
from gene_clocks.islands import Island

SCHEMA = Schema([GeneClass("node"), GeneClass("link", [float64("weight")], ends="index")], genesis_count=2)
TOPIC = "neat/demo/{}/genome"


def make_genome(island):
    marks = island.mint_many(3)
    return Genome(0, 0, {
        "node": Genes([1, 2], [0, 0]),
        "link": Genes([m.counter for m in marks], [m.robot for m in marks], [0, 0, 1], [1, 1, 1],
                      {"weight": [random.gauss(0, 1) for _ in marks]})})


def main():
    robot, broker, port, count = int(sys.argv[1]), sys.argv[2], int(sys.argv[3]), int(sys.argv[4])
    island = Island(robot, SCHEMA)
    arrived = queue.Queue()
    client = mqtt.Client(f"island-{robot}")
    client.on_connect = lambda c, *_: c.subscribe(TOPIC.format("+"))
    client.on_message = lambda c, _, message: arrived.put(message.payload)
    client.connect(broker, port)
    client.loop_start()
    taken = 0
    for _ in range(count):
        client.publish(TOPIC.format(robot), island.pack(make_genome(island), energy=1.0))
        time.sleep(0.02)
        while not arrived.empty():
            taken += island.receive(arrived.get()).genome is not None
    client.loop_stop()
    print(f"island {robot}: {taken} genomes taken, stamp {island.clock.stamp()}")


if __name__ == "__main__":
    main()
