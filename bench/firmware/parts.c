/* What firmware calls, by parts: PART_... chooses those that are measured. */
#include <gene_clocks/genome_payload.h>
#include <gene_clocks/kernel.h>
#include <gene_clocks/wire.h>

#ifdef PART_CLOCK
bool clock_start(struct gene_clocks_state* state, const struct gene_clocks_limits* limits,
                 uint64_t genesis_count);
bool clock_start(struct gene_clocks_state* state, const struct gene_clocks_limits* limits,
                 uint64_t genesis_count) {
    return gene_clocks_start(state, limits, genesis_count);
}
bool clock_restart(struct gene_clocks_state* state, const struct gene_clocks_limits* limits,
                   uint64_t genesis_count, uint64_t stored);
bool clock_restart(struct gene_clocks_state* state, const struct gene_clocks_limits* limits,
                   uint64_t genesis_count, uint64_t stored) {
    return gene_clocks_restart(state, limits, genesis_count, stored);
}
bool clock_mint(struct gene_clocks_state* state, const struct gene_clocks_limits* limits,
                uint64_t count, uint64_t* first);
bool clock_mint(struct gene_clocks_state* state, const struct gene_clocks_limits* limits,
                uint64_t count, uint64_t* first) {
    return gene_clocks_mint(state, limits, count, first);
}
bool clock_observe(struct gene_clocks_state* state, const struct gene_clocks_limits* limits,
                   uint64_t stamp);
bool clock_observe(struct gene_clocks_state* state, const struct gene_clocks_limits* limits,
                   uint64_t stamp) {
    return gene_clocks_observe(state, limits, stamp);
}
#endif

#ifdef PART_ALIGNMENT
void align_genomes(const struct gene_clocks_mark* first, size_t first_size,
                   const struct gene_clocks_mark* second, size_t second_size,
                   const struct gene_clocks_visitor* visitor);
void align_genomes(const struct gene_clocks_mark* first, size_t first_size,
                   const struct gene_clocks_mark* second, size_t second_size,
                   const struct gene_clocks_visitor* visitor) {
    gene_clocks_align(first, first_size, second, second_size, visitor);
}
#endif

#ifdef PART_DECODER
struct gene_clocks_fault decode(const uint8_t* bytes, size_t size,
                                const struct gene_clocks_wire_limits* limits,
                                struct gene_clocks_frame* frame, struct gene_clocks_genome* genome,
                                struct gene_clocks_gene* genes, uint32_t* joined);
struct gene_clocks_fault decode(const uint8_t* bytes, size_t size,
                                const struct gene_clocks_wire_limits* limits,
                                struct gene_clocks_frame* frame, struct gene_clocks_genome* genome,
                                struct gene_clocks_gene* genes, uint32_t* joined) {
    struct gene_clocks_fault fault = gene_clocks_decode_frame(bytes, size, limits, frame);
    if (fault.error) return fault;
    return gene_clocks_decode_genome(frame->payload, frame->payload_size, frame->stamp, limits,
                                     genome, genes, joined);
}
#endif

#ifdef PART_ENCODER
struct gene_clocks_fault encode(struct gene_clocks_frame* frame,
                                const struct gene_clocks_wire_limits* limits,
                                struct gene_clocks_genome genome,
                                const struct gene_clocks_gene* genes, uint32_t* joined,
                                uint8_t* buffer, size_t capacity, size_t* size);
struct gene_clocks_fault encode(struct gene_clocks_frame* frame,
                                const struct gene_clocks_wire_limits* limits,
                                struct gene_clocks_genome genome,
                                const struct gene_clocks_gene* genes, uint32_t* joined,
                                uint8_t* buffer, size_t capacity, size_t* size) {
    /* The payload first, behind the place that its header may need. */
    const size_t front = gene_clocks_frame_overhead_bytes;
    if (capacity < front) return gene_clocks_fault_at(gene_clocks_wire_no_room, 0);
    struct gene_clocks_genome_writer writer;
    struct gene_clocks_fault fault = gene_clocks_begin_genome(
        &writer, buffer + front, capacity - front, genome, frame->stamp, limits, joined);
    const size_t count = (size_t)genome.neurons + genome.connections;
    for (size_t i = 0; !fault.error && i < count; ++i) {
        fault = gene_clocks_put_gene(&writer, &genes[i]);
    }
    if (!fault.error) fault = gene_clocks_end_genome(&writer);
    if (fault.error) return fault;
    frame->payload = buffer + front;
    frame->payload_size = writer.bytes.size;
    return gene_clocks_encode_frame(frame, limits, buffer, capacity, size);
}
#endif

#ifdef PART_RAM
/* What one clock needs: its state. Limits are constant, and one for all. */
char ram_of_a_clock[sizeof(struct gene_clocks_state)];
#endif
