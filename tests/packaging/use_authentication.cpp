#include <gene_clocks/authentication/sealed_frames.hpp>

int main() {
    using namespace gene_clocks;
    authentication::Sealer sealer{authentication::Key{1}, GeneClock{RobotId{1}}};
    authentication::Opener opener{authentication::Key{2}, {}};
    const auto sealed = sealer.seal({});
    return sealed && opener.open(*sealed).index() == 1 ? 0 : 1;
}
