// A data race in a parallel loop, on purpose: ThreadSanitizer must see it through TBB. The bodies wait, so that more
// than one thread takes part.
#include <unistd.h>

#include "base/parallel.h"

int main() {
  int sum = 0;
  sateen::parallel_for(64, 4, [&](int i) {
    usleep(3000);
    sum += i;
  });
  return sum < 0;
}
