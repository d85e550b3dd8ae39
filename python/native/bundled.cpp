// What CMake links as libraries, for builds by setuptools.
#include <storage/src/posix_files.cpp>
#ifdef GENE_CLOCKS_AUTHENTICATION
#include <authentication/src/sealed_frames.cpp>
#endif
