#pragma once

#include <gene_clocks/general_genome.h>

#include <cstddef>
#include <cstdint>
#include <gene_clocks/innovation_number.hpp>
#include <gene_clocks/schema.hpp>
#include <gene_clocks/wire.hpp>
#include <span>
#include <vector>

namespace gene_clocks {

/// The genes of one class, in the order of their marks (or of their ends, where they have none).
struct ClassGenes {
    std::vector<gene_clocks_general_gene> genes;
    /// One row for each gene, one column for each attribute of the class: 64 bits whatever its type
    /// (gene_clocks_float32_of_value and its neighbours in general_checks.h turn them).
    std::vector<std::uint64_t> values;
};

/// A genome of any NEAT, after a schema.
struct GeneralGenome {
    RobotId robot{};        ///< who made it
    std::uint64_t birth{};  ///< a number that the robot gives to no other of its genomes
    std::vector<std::uint64_t> values;  ///< of the genome's own attributes
    std::vector<ClassGenes> classes;    ///< one for each of the schema's
};

/// What is wrong with a general genome, and where.
struct GeneFault {
    WireError error{};
    std::size_t offset{};      ///< reading: the byte in the payload; writing: of no meaning
    std::size_t gene_class{};  ///< the number of classes where it is no gene
    std::size_t gene{};        ///< counted in its class from 0
    std::size_t part{};        ///< gene_clocks_gene_part; attributes are counted on from there
    friend constexpr bool operator==(GeneFault, GeneFault) = default;
};

namespace detail {
constexpr GeneFault gene_fault(gene_clocks_fault fault, const gene_clocks_general_checks& checks) {
    return {static_cast<WireError>(fault.error), fault.offset, checks.gene_class, checks.gene,
            checks.part};
}
}  // namespace detail

/// Genes of a genome, all classes together, that are admitted by default.
inline constexpr std::uint32_t default_genes_max = 2048;

/// Reads a general genome off a frame's payload; memory is bounded by what the payload holds.
/// `stamp` is the frame's.
inline WireResult<GeneralGenome, GeneFault> decode_general_genome(
    std::span<const std::uint8_t> payload, Stamp stamp, const Schema& schema,
    std::uint32_t genes_max = default_genes_max) {
    gene_clocks_general_reader reader{};
    GeneralGenome genome;
    genome.values.resize(schema.attributes().size());
    auto fault = gene_clocks_open_general(&reader, payload.data(), payload.size(), stamp.value,
                                          &schema.layout(), genes_max, genome.values.data());
    if (fault.error) return detail::gene_fault(fault, reader.checks);
    genome.robot = RobotId{reader.checks.genome.robot};
    genome.birth = reader.checks.genome.birth;
    for (std::size_t i = 0; i < schema.classes().size(); ++i) {
        const std::size_t count = reader.checks.genome.counts[i];
        const std::size_t columns = schema.classes()[i].attributes.size();
        ClassGenes& genes = genome.classes.emplace_back();
        genes.genes.resize(count);
        genes.values.resize(count * columns);
        for (std::size_t gene = 0; gene < count; ++gene) {
            fault = gene_clocks_next_general_gene(&reader, &genes.genes[gene],
                                                  genes.values.data() + gene * columns);
            if (fault.error) return detail::gene_fault(fault, reader.checks);
        }
    }
    fault = gene_clocks_close_general(&reader);
    if (fault.error) return detail::gene_fault(fault, reader.checks);
    return genome;
}

/// Writes a general genome, as the payload of a frame with this stamp. Refused is what
/// `decode_general_genome` would refuse. Preconditions: there is one list of genes for each class,
/// and one value for each attribute.
inline WireResult<std::vector<std::uint8_t>, GeneFault> encode_general_genome(
    const GeneralGenome& genome, Stamp stamp, const Schema& schema,
    std::uint32_t genes_max = default_genes_max) {
    gene_clocks_general_header header{static_cast<std::uint32_t>(genome.robot), genome.birth, {}};
    for (std::size_t i = 0; i < genome.classes.size(); ++i) {
        const std::size_t count = genome.classes[i].genes.size();
        if (count > genes_max) return GeneFault{WireError::too_many_genes, 0, i, 0, 0};
        header.counts[i] = static_cast<std::uint32_t>(count);
    }
    gene_clocks_general_writer writer{};
    const auto write = [&](std::span<std::uint8_t> buffer) {
        auto fault = gene_clocks_begin_general(&writer, buffer.data(), buffer.size(), &header,
                                               genome.values.data(), stamp.value, &schema.layout(),
                                               genes_max);
        for (const ClassGenes& genes : genome.classes) {
            const std::uint64_t* values = genes.values.data();
            const std::size_t columns =
                genes.genes.empty() ? 0 : genes.values.size() / genes.genes.size();
            for (const auto& gene : genes.genes) {
                if (fault.error) return fault;
                fault = gene_clocks_put_general_gene(&writer, &gene, values);
                values += columns;
            }
        }
        return fault.error ? fault : gene_clocks_end_general(&writer);
    };
    auto fault = write({});  // finds the size
    if (fault.error != gene_clocks_wire_no_room) return detail::gene_fault(fault, writer.checks);
    std::vector<std::uint8_t> payload(writer.bytes.size);
    fault = write(payload);
    if (fault.error) return detail::gene_fault(fault, writer.checks);
    return payload;
}

}  // namespace gene_clocks
