# Debian 12 with all packages that muster needs. scripts/setup is the only list of them.
#   docker build --tag muster .
#   docker run --rm --interactive --tty muster                         # a shell in the tree
#   docker run --rm --volume "$PWD/out:/muster/out" muster scripts/demo  # the main job; its pictures go to out/
#   docker run --rm muster scripts/test                                # builds and runs the tests
FROM debian:12
WORKDIR /muster

# First, so that a change of a source does not install the packages anew.
COPY scripts/setup scripts/setup
RUN scripts/setup --lint --page --browser

COPY . .
CMD ["bash"]
