"""From files that have the right shape to the model: expand what repeats, resolve what refers, compute what follows."""
