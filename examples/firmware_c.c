/* Two robots in C99 that exchange frames: what firmware does with kernel.h, wire.h and
 * genome_payload.h. No heap, no library behind the protocol; printf is for the reader alone. */
#include <gene_clocks/genome_payload.h>
#include <gene_clocks/kernel.h>
#include <gene_clocks/wire.h>
#include <stdio.h>

/* ---- What the fleet agrees on --------------------------------------------------------------- */

enum { genesis_count = 5, neurons_max = 16, connections_max = 32 };
enum {
    payload_bytes_max = gene_clocks_genome_header_bytes_max +
                        neurons_max * gene_clocks_neuron_bytes_max +
                        connections_max * gene_clocks_connection_bytes_max,
    frame_bytes_max = payload_bytes_max + gene_clocks_frame_overhead_bytes
};

static const struct gene_clocks_limits clock_limits = {UINT64_MAX, 1000, UINT64_MAX};
static const struct gene_clocks_wire_limits wire_limits = {
    frame_bytes_max,
    genesis_count,
    neurons_max,
    connections_max,
    1000.0f,
    10.0f,
    0 /* no salt: genomes as small as these are checked in no time, whoever made them up */};

/* ---- A robot -------------------------------------------------------------------------------- */

struct robot {
    uint32_t id;
    struct gene_clocks_state clock;
    struct gene_clocks_genome genome;
    struct gene_clocks_gene genes[neurons_max + connections_max]; /* sorted by mark */
    uint64_t flash;                                               /* stands for stable storage */
    uint32_t births;                                              /* genomes made so far */
    unsigned refused;                                             /* frames that were dropped */
};

static size_t gene_count(const struct robot* robot) {
    return (size_t)robot->genome.neurons + robot->genome.connections;
}

static struct gene_clocks_gene neuron(struct gene_clocks_mark mark,
                                      enum gene_clocks_gene_kind kind) {
    const struct gene_clocks_gene gene = {mark, kind, false, false, {0, 0}, 0.0f};
    return gene;
}

static struct gene_clocks_gene connection(struct gene_clocks_mark mark, uint16_t source,
                                          uint16_t target, float weight) {
    const struct gene_clocks_gene gene = {mark,  gene_clocks_connection, true,
                                          false, {source, target},       weight};
    return gene;
}

/* Every robot starts with the genes 1 ... 5 of robot 0: input, bias, output and two connections. */
static bool start(struct robot* robot, uint32_t id) {
    static const enum gene_clocks_gene_kind kinds[] = {gene_clocks_input, gene_clocks_bias,
                                                       gene_clocks_output};
    const struct gene_clocks_genome genome = {id, 0, 3, 2};
    robot->id = id;
    robot->genome = genome;
    robot->births = 1; /* must not begin anew after a restart; see docs/add-to-your-neat.md */
    robot->refused = 0;
    for (uint16_t i = 0; i < 3; ++i) {
        const struct gene_clocks_mark mark = {i + 1u, 0};
        robot->genes[i] = neuron(mark, kinds[i]);
    }
    for (uint16_t i = 0; i < 2; ++i) {
        const struct gene_clocks_mark mark = {i + 4u, 0};
        robot->genes[3 + i] = connection(mark, i, 2, 0.5f);
    }
    robot->flash = genesis_count + 1;
    return gene_clocks_start(&robot->clock, &clock_limits, genesis_count);
}

/* Puts a hidden neuron into the connection at `index`: three new genes, whose marks are above all
 * others, so that they go to the end. */
static bool add_neuron(struct robot* robot, size_t index) {
    struct gene_clocks_gene* const split = &robot->genes[index];
    gene_clocks_counter first;
    if (robot->genome.neurons == neurons_max) return false;
    if (robot->genome.connections + 2 > connections_max) return false;
    if (!gene_clocks_mint(&robot->clock, &clock_limits, 3, &first)) return false;
    const struct gene_clocks_mark marks[] = {
        {first, robot->id}, {first + 1, robot->id}, {first + 2, robot->id}};
    const uint16_t hidden = robot->genome.neurons++;
    struct gene_clocks_gene* const end = &robot->genes[gene_count(robot) - 1];
    robot->genome.connections = (uint16_t)(robot->genome.connections + 2);
    split->is_enabled = false;
    /* It is another genome now, and this robot's. */
    robot->genome.robot = robot->id;
    robot->genome.birth = robot->births++;
    end[0] = neuron(marks[0], gene_clocks_hidden);
    end[1] = connection(marks[1], split->ends.source, hidden, 1.0f);
    end[2] = connection(marks[2], hidden, split->ends.target, split->weight);
    return true;
}

/* ---- Messages ------------------------------------------------------------------------------- */

/* Writes the robot's genome as a frame; 0 where it does not fit or the counter cannot be stored. */
static size_t broadcast(struct robot* robot, uint8_t* bytes, size_t capacity) {
    static uint8_t payload[payload_bytes_max];
    static uint32_t joined[GENE_CLOCKS_JOINED_WORDS(connections_max)];
    struct gene_clocks_genome_writer writer;
    struct gene_clocks_fault fault = gene_clocks_begin_genome(
        &writer, payload, sizeof payload, robot->genome, robot->clock.next, &wire_limits, joined);
    for (size_t i = 0; !fault.error && i < gene_count(robot); ++i) {
        fault = gene_clocks_put_gene(&writer, &robot->genes[i]);
    }
    if (!fault.error) fault = gene_clocks_end_genome(&writer);
    if (fault.error) return 0;

    /* Before anything leaves: the counter goes to stable storage, once for a block of marks. */
    if (robot->flash < robot->clock.durable) robot->flash = robot->clock.durable;

    const struct gene_clocks_frame frame = {robot->clock.next, robot->id, 100.0f, payload,
                                            writer.bytes.size};
    size_t size;
    fault = gene_clocks_encode_frame(&frame, &wire_limits, bytes, capacity, &size);
    return fault.error ? 0 : size;
}

/* Takes the genome of a frame for its own. Where the frame is refused, the robot stays as it is. */
static enum gene_clocks_wire_error receive(struct robot* robot, const uint8_t* bytes, size_t size) {
    static struct gene_clocks_gene genes[neurons_max + connections_max];
    static uint32_t joined[GENE_CLOCKS_JOINED_WORDS(connections_max)];
    struct gene_clocks_frame frame;
    struct gene_clocks_genome genome;
    struct gene_clocks_fault fault = gene_clocks_decode_frame(bytes, size, &wire_limits, &frame);
    if (!fault.error) {
        fault = gene_clocks_decode_genome(frame.payload, frame.payload_size, frame.stamp,
                                          &wire_limits, &genome, genes, joined);
    }
    /* The clock hears the stamp before any gene is used. */
    if (!fault.error && !gene_clocks_observe(&robot->clock, &clock_limits, frame.stamp)) {
        fault.error = gene_clocks_wire_stamp;
    }
    if (fault.error) {
        ++robot->refused;
        return fault.error;
    }
    robot->genome = genome;
    for (size_t i = 0; i < gene_count(robot); ++i) robot->genes[i] = genes[i];
    return gene_clocks_wire_ok;
}

/* ---- Two of them ---------------------------------------------------------------------------- */

static void print(const struct robot* robot) {
    printf("robot %u, clock %llu:", (unsigned)robot->id, (unsigned long long)robot->clock.next);
    for (size_t i = 0; i < gene_count(robot); ++i) {
        const struct gene_clocks_mark mark = robot->genes[i].mark;
        printf(" %llu.%u", (unsigned long long)mark.counter, (unsigned)mark.robot);
    }
    printf("\n");
}

static bool are_ascending(const struct robot* robot) {
    for (size_t i = 1; i < gene_count(robot); ++i) {
        if (!gene_clocks_less(robot->genes[i - 1].mark, robot->genes[i].mark)) return false;
    }
    return true;
}

int main(void) {
    static struct robot first, second;
    static uint8_t bytes[frame_bytes_max];
    if (!start(&first, 1) || !start(&second, 2)) return 1;

    /* The first robot grows a neuron and tells; the second grows another one on top of it. */
    if (!add_neuron(&first, 3)) return 1;
    size_t size = broadcast(&first, bytes, sizeof bytes);
    if (size == 0 || receive(&second, bytes, size) != gene_clocks_wire_ok) return 1;
    if (!add_neuron(&second, 6)) return 1;
    size = broadcast(&second, bytes, sizeof bytes);
    if (size == 0 || receive(&first, bytes, size) != gene_clocks_wire_ok) return 1;
    print(&first);
    print(&second);

    /* A radio that turns over any one bit: every such frame is refused, and nothing changes. */
    const struct gene_clocks_state before = first.clock;
    for (size_t bit = 0; bit < 8 * size; ++bit) {
        bytes[bit / 8] ^= (uint8_t)(1u << bit % 8);
        if (receive(&first, bytes, size) == gene_clocks_wire_ok) return 1;
        bytes[bit / 8] ^= (uint8_t)(1u << bit % 8);
    }
    printf("frame of %u bytes for %u genes; with a wrong bit: %u of %u refused\n", (unsigned)size,
           (unsigned)gene_count(&first), first.refused, (unsigned)(8 * size));

    const bool are_alike = gene_count(&first) == 11 && gene_count(&second) == 11 &&
                           first.clock.next == second.clock.next && are_ascending(&first);
    const bool is_unchanged =
        first.clock.next == before.next && first.clock.durable == before.durable;
    return are_alike && is_unchanged && first.refused == 8 * size ? 0 : 1;
}
