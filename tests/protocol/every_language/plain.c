/* The headers that are plain C, as C and as C++ read them. Built by check.cmake, also with the
 * include inside of extern "C" (INSIDE_EXTERN_C). */
#ifdef INSIDE_EXTERN_C
extern "C" {
#endif
#include <gene_clocks/fragments.h>
#include <gene_clocks/general_genome.h>
#ifdef INSIDE_EXTERN_C
}
#endif

static const char* const activations[] = {"tanh", "relu", "sigmoid"};
static const struct gene_clocks_attribute node_attributes[] = {
    GENE_CLOCKS_FLOAT64("bias", GENE_CLOCKS_FLOAT64_MAX_BITS),
    GENE_CLOCKS_ENUMERATION("activation", activations)};
static const struct gene_clocks_attribute link_attributes[] = {
    GENE_CLOCKS_FLOAT32("weight", 0x41f00000), GENE_CLOCKS_FLAG("enabled"),
    GENE_CLOCKS_INTEGER("age", INT64_MIN, INT64_MAX)};
static const struct gene_clocks_gene_class classes[] = {
    {"node", true, gene_clocks_no_ends, node_attributes, 2},
    {"link", true, gene_clocks_ends_by_index, link_attributes, 3}};
static const struct gene_clocks_schema schema = {2, GENE_CLOCKS_NULL, 0, classes, 2};

/* Splits a message and puts it together again. */
static int fragments_come_together(void) {
    const uint8_t message[12] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
    static uint8_t memory[12];
    static struct gene_clocks_assembly assembly;
    struct gene_clocks_assembler assembler = {&assembly, memory, sizeof memory, 1, 0};
    struct gene_clocks_split split;
    const uint8_t* whole = GENE_CLOCKS_NULL;
    size_t size = 0;
    if (gene_clocks_split_message(&split, message, sizeof message, 7, 0, 10)) return 0;
    for (uint8_t i = 0; i <= split.last; ++i) {
        uint8_t fragment[10];
        const size_t bytes = gene_clocks_put_fragment(&split, i, fragment);
        gene_clocks_take_fragment(&assembler, fragment, bytes, &whole, &size);
    }
    return size == sizeof message && whole[0] == 1 && whole[11] == 12;
}

/* Writes a genome of two nodes and a link, and reads it again. */
int main(void) {
    struct gene_clocks_layout layout;
    struct gene_clocks_general_writer writer;
    struct gene_clocks_general_reader reader;
    const struct gene_clocks_general_header header = {7, 1, {2, 1, 0, 0, 0, 0, 0, 0}};
    struct gene_clocks_general_gene gene = {1, 0, {0, 0, 0}, {0, 0, 0}};
    uint64_t values[3] = {0, 2, 0};
    uint8_t buffer[128];
    if (gene_clocks_lay_out(&schema, &layout).error) return 1;
    if (gene_clocks_begin_general(&writer, buffer, sizeof buffer, &header, values, 9, &layout, 10)
            .error) {
        return 2;
    }
    if (gene_clocks_put_general_gene(&writer, &gene, values).error) return 3;
    gene.counter = 2;
    if (gene_clocks_put_general_gene(&writer, &gene, values).error) return 4;
    gene.counter = 8;
    gene.robot = 7;
    gene.target.index = 1;
    values[0] = gene_clocks_value_of_float32(-0.5f);
    values[1] = 1;
    values[2] = gene_clocks_value_of_integer(-12);
    if (gene_clocks_put_general_gene(&writer, &gene, values).error) return 5;
    if (gene_clocks_end_general(&writer).error) return 6;

    if (gene_clocks_open_general(&reader, buffer, writer.bytes.size, 9, &layout, 10, values)
            .error) {
        return 7;
    }
    while (gene_clocks_are_genes_left(&reader.checks)) {
        if (gene_clocks_next_general_gene(&reader, &gene, values).error) return 8;
    }
    if (gene_clocks_close_general(&reader).error) return 9;
    return gene.counter == 8 && gene.robot == 7 && gene.target.index == 1 &&
                   gene_clocks_float32_of_value(values[0]) == -0.5f && values[1] == 1 &&
                   gene_clocks_integer_of_value(values[2]) == -12 && fragments_come_together()
               ? 0
               : 10;
}
