"""How forces are drawn: force plans, Zhukovsky's lever, friction."""
