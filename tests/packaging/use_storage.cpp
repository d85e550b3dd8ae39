#include <gene_clocks/gene_clock.hpp>
#include <gene_clocks/storage/file_store.hpp>

// Asks for a folder that is not there: what a user would have to handle.
int main() {
    using namespace gene_clocks;
    storage::FileStore store{storage::PosixFiles{"no such folder"}, RobotId{1}};
    return store.open().error == StorageError::device ? 0 : 1;
}
