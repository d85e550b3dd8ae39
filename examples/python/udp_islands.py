#!/usr/bin/env python3
"""neat-python on several machines, over UDP: udp_islands.py ROBOT PORT PEER... (PEER is HOST:PORT).

Start one on each machine, each with an id of its own; stop and start them as you like."""

import socket
import sys

import neat

from gene_clocks.adapters.neat_python import NeatIsland


def evaluate(genomes, config):
    for _, genome in genomes:
        net = neat.nn.FeedForwardNetwork.create(genome, config)
        genome.fitness = 4.0 - sum((net.activate((a, b))[0] - (a != b)) ** 2 for a in (0, 1) for b in (0, 1))


# ---- begin: what Gene Clocks takes
robot, port, peers = int(sys.argv[1]), int(sys.argv[2]), [p.rsplit(":", 1) for p in sys.argv[3:]]
link = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
link.bind(("", port))
link.setblocking(False)


def send(frame):
    for host, peer in peers:
        link.sendto(frame, (host, int(peer)))


def receive():
    try:
        while True:
            yield link.recv(65535)
    except BlockingIOError:
        return


def join(population):
    island = NeatIsland(population, robot, folder=f"island-{robot}")
    population.add_reporter(island.migration(send, receive, every=5))
# ---- end


if __name__ == "__main__":
    config = neat.Config(neat.DefaultGenome, neat.DefaultReproduction, neat.DefaultSpeciesSet,
                         neat.DefaultStagnation, "config-feedforward")
    population = neat.Population(config)
    join(population)
    print(population.run(evaluate, 300))
