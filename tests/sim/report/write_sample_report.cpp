// Writes the report of made-up runs, for page_test.py to look at: write_sample_report FOLDER KIND
#include <iostream>

#include "sim/report/report.hpp"
#include "tests/sim/report/sample_input.hpp"

int main(int count, char** arguments) {
    if (count != 3) {
        std::cerr << "usage: write_sample_report FOLDER KIND\n";
        return 2;
    }
    gene_clocks::report::write_report(gene_clocks::report::sample_study(arguments[2]),
                                      arguments[1]);
}
