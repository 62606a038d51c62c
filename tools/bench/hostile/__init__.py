"""Attack a driving robot from a process under each user of docs/deploy.md, and judge it by truth.

``draw`` decides everything about a run from its number; ``contents`` makes what is said;
``client`` says it at every door that the kernel lets it reach; ``siege`` holds robot and clients;
``verdict`` judges what was seen. ``tools.bench.measure.hostile_users`` counts.
"""
