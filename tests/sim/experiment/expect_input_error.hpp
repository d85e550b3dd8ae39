#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "sim/settings/input_error.hpp"

namespace gene_clocks::test {

/// The message of the InputError that a function throws; fails the test if it throws none.
template <typename Function>
std::string input_error(Function function) {
    try {
        function();
    } catch (const experiment::InputError& error) {
        return error.what();
    }
    ADD_FAILURE() << "no InputError was thrown";
    return {};
}

}  // namespace gene_clocks::test
