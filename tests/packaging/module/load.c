/* Loads the plugin and calls its entry, as a simulator does with a controller. */
#include <dlfcn.h>
#include <stdio.h>

int main(void) {
    void* plugin = dlopen(PLUGIN, RTLD_NOW);
    if (plugin == NULL) {
        fprintf(stderr, "%s\n", dlerror());
        return 1;
    }
    /* C++ mangles the name of a function, but for that of main. */
    int (*entry)(void) = (int (*)(void))dlsym(plugin, "_Z11plugin_mainv");
    return entry == NULL ? 2 : entry();
}
