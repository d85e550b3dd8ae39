// What CMake links as libraries, for builds by setuptools.
#include "protocol/storage/src/posix_files.cpp"
#ifdef GENE_CLOCKS_AUTHENTICATION
#include "protocol/authentication/src/sealed_frames.cpp"
#endif
